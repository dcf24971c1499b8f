// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/colour_scale.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace brainshift::pipelines {

namespace {

// Pale grey, then the yellow, orange and red of ColorBrewer's YlOrRd (Brewer 2003): lightness falls evenly.
constexpr Colour sequential_nodes[] = {{222, 224, 228}, {254, 228, 150}, {254, 178, 76},
                                       {252, 100, 42},  {214, 20, 28},   {118, 0, 38}};
constexpr Colour diverging_nodes[] = {{150, 215, 255}, {40, 120, 220}, {8, 8, 10}, {230, 110, 20}, {255, 225, 150}};

}  // namespace

std::span<const Colour> ColourScale::nodes() const {
  return map == ColourMap::sequential ? std::span<const Colour>(sequential_nodes)
                                      : std::span<const Colour>(diverging_nodes);
}

Colour ColourScale::colour_of(double value) const {
  const std::span<const Colour> colours = nodes();
  const double relative = std::clamp((value - low) / (high - low), 0.0, 1.0);
  const double place = relative * static_cast<double>(colours.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), colours.size() - 2);
  return blend(colours[below], colours[below + 1], place - static_cast<double>(below));
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

void draw_colour_bar(Svg& picture, const ColourScale& scale, const Eigen::Vector2d& corner, double height,
                     const Colour& text) {
  constexpr double width = 16;
  picture.gradient(corner, {width, height}, scale.nodes());
  constexpr int intervals = 4;
  for (int tick = 0; tick <= intervals; ++tick) {
    const double share = static_cast<double>(tick) / intervals;
    char label[32];
    std::snprintf(label, sizeof label, "%.3g", scale.low + (scale.high - scale.low) * share);
    const Eigen::Vector2d place = corner + Eigen::Vector2d(width, height * (1 - share));
    picture.line(place, place + Eigen::Vector2d(4, 0), {.colour = text});
    picture.text(place + Eigen::Vector2d(8, 0), label, {.fill = text});
  }
  picture.text(corner - Eigen::Vector2d(0, 16), scale.title, {.fill = text});
}

}  // namespace brainshift::pipelines
