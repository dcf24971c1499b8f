// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pipelines/report/measure_table.hpp"
#include "pipelines/report/svg.hpp"
#include "segmentation/files/write_text.hpp"

namespace brainshift::pipelines {

namespace {

using Eigen::Vector2d;

constexpr int width = plot_width, height = plot_height, left = 80, right = 24, bottom = 58;
constexpr int title_height = 40, key_height = 20;
constexpr Colour grid = {225, 225, 225};
constexpr std::array<Colour, 6> colours = {
    {{20, 90, 170}, {210, 90, 20}, {40, 140, 60}, {150, 40, 140}, {110, 110, 110}, {190, 160, 0}}};

// One axis: from values to a share of its length, with round ticks.
struct Axis {
  bool logarithmic = false;
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  bool shows(double value) const { return std::isfinite(value) && !(logarithmic && value <= 0); }
  double at(double value) const { return logarithmic ? std::log10(value) : value; }
  void include(double value) {
    low = std::min(low, at(value));
    high = std::max(high, at(value));
  }
  double share(double value) const { return high > low ? (at(value) - low) / (high - low) : 0.5; }

  std::vector<double> candidates() const {
    std::vector<double> ticks;
    if (!(high > low)) {
      return ticks;
    }
    if (logarithmic) {
      const bool decades_alone = high - low > 3;
      for (double decade = std::floor(low); decade <= high + 1; ++decade) {
        for (const double digit : {1.0, 2.0, 5.0}) {
          if (digit == 1 || !decades_alone) {
            ticks.push_back(digit * std::pow(10, decade));
          }
        }
      }
      return ticks;
    }
    const double rough = (high - low) / 5, power = std::pow(10, std::floor(std::log10(rough)));
    const double step = power * (rough / power < 1.5 ? 1 : rough / power < 3.5 ? 2 : rough / power < 7.5 ? 5 : 10);
    for (double tick = std::ceil(low / step) * step; tick <= high + step / 1000; tick += step) {
      ticks.push_back(std::abs(tick) < step / 1000 ? 0 : tick);
    }
    return ticks;
  }

  std::vector<double> ticks() const {
    std::vector<double> ticks = candidates();
    std::erase_if(ticks, [this](double t) { return share(t) < -1e-9 || share(t) > 1 + 1e-9; });
    return ticks;
  }
};

struct Frame {
  Axis x, y;
  int top;

  double x_of(double value) const { return left + x.share(value) * (width - left - right); }
  double y_of(double value) const { return height - bottom - y.share(value) * (height - top - bottom); }
};

// Of the key, above the curves: it hides none.
std::size_t key_columns(const Plot& plot) {
  constexpr std::size_t longest = 36;  // letters that fit half the width
  return std::ranges::any_of(plot.series, [](const Series& s) { return s.name.size() > longest; }) ? 1 : 2;
}

Frame frame_of(const Plot& plot) {
  const std::size_t columns = key_columns(plot);
  const auto rows = static_cast<int>((plot.series.size() + columns - 1) / columns);
  const bool logarithmic = plot.scale == Scale::log_log;
  Frame frame{.x = {.logarithmic = logarithmic},
              .y = {.logarithmic = logarithmic},
              .top = title_height + key_height * rows + (plot.y_label.empty() ? 0 : key_height)};
  for (const Series& series : plot.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (frame.x.shows(series.x[i]) && frame.y.shows(series.y[i])) {
        frame.x.include(series.x[i]);
        frame.y.include(series.y[i]);
      }
    }
  }
  return frame;
}

void draw_axes(Svg& svg, const Frame& frame, const Plot& plot) {
  for (const double tick : frame.x.ticks()) {
    const double x = frame.x_of(tick);
    svg.line({x, frame.top}, {x, height - bottom}, {.colour = grid});
    svg.text({x, height - bottom + 16}, readable(tick), {.size = 13, .anchor = Anchor::centre});
  }
  for (const double tick : frame.y.ticks()) {
    const double y = frame.y_of(tick);
    svg.line({left, y}, {width - right, y}, {.colour = grid});
    svg.text({left - 8, y}, readable(tick), {.size = 13, .anchor = Anchor::right});
  }
  svg.line({left, frame.top}, {left, height - bottom}, {.width = 1.5});
  svg.line({left, height - bottom}, {width - right, height - bottom}, {.width = 1.5});
  svg.text({width / 2.0, 22}, plot.title, {.size = 16, .anchor = Anchor::centre, .bold = true});
  svg.text({(left + width - right) / 2.0, height - 18}, plot.x_label, {.anchor = Anchor::centre});
  svg.text({12, frame.top - 14}, plot.y_label, {});
}

void draw_series(Svg& svg, const Frame& frame, const Series& series, const Colour& colour) {
  std::vector<Vector2d> places;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (frame.x.shows(series.x[i]) && frame.y.shows(series.y[i])) {
      places.emplace_back(frame.x_of(series.x[i]), frame.y_of(series.y[i]));
    }
  }
  if (series.joined) {
    svg.polyline(places, {.colour = colour, .width = 2});
  }
  if (!series.joined || places.size() < 40) {  // more on a line would hide it
    for (const Vector2d& place : places) {
      svg.dot(place, 3, colour);
    }
  }
}

void draw_key(Svg& svg, const Series& series, const Colour& colour, std::size_t place, std::size_t columns) {
  const double x = left + static_cast<double>(place % columns) * 0.5 * (width - left - right);
  const double y = title_height + 4 + key_height * static_cast<double>(place / columns);
  svg.line({x, y}, {x + 22, y}, {.colour = colour, .width = 3});
  svg.text({x + 30, y}, series.name, {.size = 13});
}

}  // namespace

std::string plot_svg(const Plot& plot) {
  const Frame frame = frame_of(plot);
  Svg svg(plot.file, plot.title, width, height);
  svg.rectangle({0, 0}, {width, height}, colour::white);
  draw_axes(svg, frame, plot);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    draw_series(svg, frame, plot.series[i], colours[i % colours.size()]);
    draw_key(svg, plot.series[i], colours[i % colours.size()], i, key_columns(plot));
  }
  return std::move(svg).str();
}

void draw(const std::filesystem::path& folder, const Plot& plot) {
  write_text(folder / (plot.file + ".svg"), plot_svg(plot));
}

}  // namespace brainshift::pipelines
