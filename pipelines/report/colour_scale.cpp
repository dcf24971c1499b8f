// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/colour_scale.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

namespace brainshift::pipelines {

namespace {

// Pale grey, then the yellow, orange and red of ColorBrewer's YlOrRd (Brewer 2003): lightness falls evenly.
constexpr Colour sequential_nodes[] = {{222, 224, 228}, {254, 228, 150}, {254, 178, 76},
                                       {252, 100, 42},  {214, 20, 28},   {118, 0, 38}};
constexpr Colour diverging_nodes[] = {{150, 215, 255}, {40, 120, 220}, {8, 8, 10}, {230, 110, 20}, {255, 225, 150}};

}  // namespace

Colour ColourScale::colour_of(double value) const {
  const std::span<const Colour> nodes = map == ColourMap::sequential ? std::span<const Colour>(sequential_nodes)
                                                                     : std::span<const Colour>(diverging_nodes);
  const double relative = std::clamp((value - low) / (high - low), 0.0, 1.0);
  const double place = relative * static_cast<double>(nodes.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), nodes.size() - 2);
  return blend(nodes[below], nodes[below + 1], place - static_cast<double>(below));
}

double round_up(double value) {
  if (!(value > 0)) {
    return 1;
  }
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.6, 2.0, 3.0, 4.0, 6.0, 8.0}) {
    if (step * power >= value * (1 - 1e-9)) {
      return step * power;
    }
  }
  return 10 * power;
}

void draw_colour_bar(Canvas& canvas, const ColourScale& scale, int x, int y, int height, const Colour& text) {
  constexpr int width = 16;
  for (int row = 0; row < height; ++row) {
    const double value = scale.high + (scale.low - scale.high) * row / (height - 1);
    fill_rectangle(canvas, x, y + row, width, 1, scale.colour_of(value));
  }
  constexpr int intervals = 4;
  for (int tick = 0; tick <= intervals; ++tick) {
    const double value = scale.low + (scale.high - scale.low) * tick / intervals;
    const double row = y + (height - 1) * (1.0 - static_cast<double>(tick) / intervals);
    char label[32];
    std::snprintf(label, sizeof label, "%.3g", value);
    fill_rectangle(canvas, x + width, static_cast<int>(row), 4, 1, text);
    draw_text(canvas, {x + width + 8.0, row}, label, {.size = 14, .fill = text});
  }
  draw_text(canvas, {static_cast<double>(x), y - 16.0}, scale.title, {.size = 14, .fill = text});
}

}  // namespace brainshift::pipelines
