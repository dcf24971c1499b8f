// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "pipelines/report/canvas.hpp"

namespace brainshift::pipelines {

namespace {

constexpr int width = 900, height = 560, left = 100, right = 30, top = 60, bottom = 70;
constexpr std::array<Colour, 6> colours = {
    {{20, 90, 170}, {210, 90, 20}, {40, 140, 60}, {150, 40, 140}, {110, 110, 110}, {190, 160, 0}}};

/// One axis: from values to pixels, with round ticks.
struct Axis {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool logarithmic = false;

  double at(double value) const { return logarithmic ? std::log10(value) : value; }
  void include(double value) {
    low = std::min(low, at(value));
    high = std::max(high, at(value));
  }
  double share(double value) const { return high > low ? (at(value) - low) / (high - low) : 0.5; }

  std::vector<double> ticks() const {
    std::vector<double> ticks;
    if (logarithmic) {
      for (double decade = std::floor(low); decade <= high + 1; ++decade) {
        for (const double digit : {1.0, 2.0, 5.0}) {
          ticks.push_back(digit * std::pow(10, decade));
        }
      }
    } else {
      const double rough = (high - low) / 5, power = std::pow(10, std::floor(std::log10(rough)));
      const double step = power * (rough / power < 1.5 ? 1 : rough / power < 3.5 ? 2 : rough / power < 7.5 ? 5 : 10);
      for (double tick = std::ceil(low / step) * step; tick <= high + step / 1000; tick += step) {
        ticks.push_back(std::abs(tick) < step / 1000 ? 0 : tick);
      }
    }
    std::erase_if(ticks, [this](double t) { return share(t) < -1e-9 || share(t) > 1 + 1e-9; });
    return ticks;
  }
};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

Eigen::Vector2d place(const Axis& x, const Axis& y, double a, double b) {
  return {left + x.share(a) * (width - left - right), height - bottom - y.share(b) * (height - top - bottom)};
}

void draw_axes(Canvas& canvas, const Axis& x, const Axis& y, const Plot& plot) {
  constexpr Colour grid = {225, 225, 225};
  for (const double tick : x.ticks()) {
    const double px = left + x.share(tick) * (width - left - right);
    draw_line(canvas, {px, top}, {px, height - bottom}, 1, grid);
    draw_text(canvas, {px, height - bottom + 16}, number(tick), {.size = 14, .anchor = Anchor::centre});
  }
  for (const double tick : y.ticks()) {
    const double py = height - bottom - y.share(tick) * (height - top - bottom);
    draw_line(canvas, {left, py}, {width - right, py}, 1, grid);
    draw_text(canvas, {left - 8.0, py}, number(tick), {.size = 14, .anchor = Anchor::right});
  }
  draw_line(canvas, {left, top}, {left, height - bottom}, 1.5, colour::ink);
  draw_line(canvas, {left, height - bottom}, {width - right, height - bottom}, 1.5, colour::ink);
  draw_text(canvas, {width / 2.0, 22}, plot.title, {.size = 18, .anchor = Anchor::centre, .bold = true});
  draw_text(canvas, {width / 2.0, height - 22.0}, plot.x_label, {.size = 16, .anchor = Anchor::centre});
  draw_text(canvas, {10, 44}, plot.y_label, {.size = 16});
}

void draw_series(Canvas& canvas, const Axis& x, const Axis& y, const Series& series, const Colour& colour, int row) {
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const Eigen::Vector2d here = place(x, y, series.x[i], series.y[i]);
    if (i > 0 && series.joined) {
      draw_line(canvas, place(x, y, series.x[i - 1], series.y[i - 1]), here, 2, colour);
    }
    if (series.x.size() < 40 || !series.joined) {
      draw_line(canvas, here, here, 7, colour);
    }
  }
  const double line = top + 18.0 + 22.0 * row;
  draw_line(canvas, {left + 20.0, line}, {left + 50.0, line}, 3, colour);
  draw_text(canvas, {left + 58.0, line}, series.name, {.size = 15});
}

}  // namespace

void draw(const std::filesystem::path& folder, const Plot& plot) {
  Axis x{.logarithmic = plot.logarithmic}, y{.logarithmic = plot.logarithmic};
  for (const Series& s : plot.series) {
    std::for_each(s.x.begin(), s.x.end(), [&x](double v) { x.include(v); });
    std::for_each(s.y.begin(), s.y.end(), [&y](double v) { y.include(v); });
  }
  Canvas canvas(width, height, colour::white);
  draw_axes(canvas, x, y, plot);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    draw_series(canvas, x, y, plot.series[i], colours[i % colours.size()], static_cast<int>(i));
  }
  const std::filesystem::path file = folder / (plot.file + ".png");
  std::ofstream out(file, std::ios::binary);
  out << encode_png(canvas);
  if (!out.flush()) {
    throw std::runtime_error(file.string() + ": cannot be written");
  }
}

}  // namespace brainshift::pipelines
