// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/history_plot.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

#include "pipelines/report/colour_scale.hpp"
#include "pipelines/report/measure_table.hpp"

namespace brainshift::pipelines {

namespace {

constexpr double width = 560;
constexpr double height = 300;
constexpr double left = 70;
constexpr double right = 20;
constexpr double top = 34;
constexpr double bottom = 46;

using Row = solve::HistoryRow;
using Value = std::function<double(const Row&)>;

// The plot's frame: values to pixels.
struct Axes {
  std::string x_name;
  double x_high;
  double y_low;
  double y_high;
  bool logarithmic;

  double x(double value) const { return left + (width - left - right) * value / x_high; }
  double y(double value) const {
    const auto scaled = [&](double v) { return logarithmic ? std::log10(v) : v; };
    const double relative = (scaled(value) - scaled(y_low)) / (scaled(y_high) - scaled(y_low));
    return height - bottom - (height - top - bottom) * relative;
  }
};

void text(std::ostream& svg, double x, double y, const std::string& anchor, const std::string& words) {
  svg << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\">" << words << "</text>\n";
}

void grid_line(std::ostream& svg, const Axes& axes, double value) {
  svg << "<line x1=\"" << left << "\" x2=\"" << width - right << "\" y1=\"" << axes.y(value) << "\" y2=\""
      << axes.y(value) << "\" stroke=\"#d8dce2\"/>\n";
  text(svg, left - 8, axes.y(value) + 4, "end", readable(value));
}

void draw_frame(std::ostream& svg, const Axes& axes, const std::string& title) {
  if (axes.logarithmic) {
    for (double value = axes.y_low; value <= axes.y_high * 1.001; value *= 10) {
      grid_line(svg, axes, value);
    }
  } else {
    for (int tick = 0; tick <= 4; ++tick) {
      grid_line(svg, axes, axes.y_low + (axes.y_high - axes.y_low) * tick / 4);
    }
  }
  for (int tick = 0; tick <= 4; ++tick) {
    text(svg, axes.x(axes.x_high * tick / 4), height - bottom + 20, "middle", readable(axes.x_high * tick / 4));
  }
  text(svg, (left + width - right) / 2, height - 6, "middle", axes.x_name);
  text(svg, left - 50, 18, "start", title);
}

double step_of(const Row& row) {
  return row.step;
}

void draw_curve(std::ostream& svg, const Axes& axes, const std::vector<Row>& history, const Value& place,
                const Value& value, const std::string& stroke) {
  svg << "<polyline fill=\"none\" stroke=\"" << stroke << "\" stroke-width=\"2\" points=\"";
  for (const Row& row : history) {
    const double v = value(row);
    if (std::isfinite(v) && !(axes.logarithmic && v <= 0)) {
      svg << axes.x(place(row)) << ',' << axes.y(std::clamp(v, axes.y_low, axes.y_high)) << ' ';
    }
  }
  svg << "\"/>\n";
}

void draw_key(std::ostream& svg, double x, const std::string& fill, const std::string& name) {
  svg << "<rect x=\"" << x << "\" y=\"9\" width=\"12\" height=\"10\" fill=\"" << fill << "\"/>\n";
  text(svg, x + 16, 18, "start", name);
}

std::ostringstream begin_svg(const std::string& label) {
  std::ostringstream svg;
  svg.precision(5);
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << ' ' << height
      << "\" role=\"img\" aria-label=\"" << label
      << "\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#20242a\">\n";
  return svg;
}

}  // namespace

std::string convergence_plot(const std::vector<Row>& history, double tolerance) {
  double low = tolerance > 0 ? tolerance : std::numeric_limits<double>::infinity();
  double high = 0;
  for (const Row& row : history) {
    for (const double value : {row.error_bound, row.residual}) {
      if (std::isfinite(value) && value > 0) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
  }
  if (history.size() < 2 || high == 0) {
    return {};
  }
  const Axes axes{.x_name = "step",
                  .x_high = step_of(history.back()),
                  .y_low = std::pow(10, std::floor(std::log10(low))),
                  .y_high = std::pow(10, std::ceil(std::log10(high * 1.001))),
                  .logarithmic = true};
  std::ostringstream svg = begin_svg("bound of the remaining error over the steps");
  const auto loaded = std::ranges::find_if(history, [](const Row& row) { return row.time >= 1; });
  if (loaded != history.begin() && loaded != history.end()) {  // a coarse start is under the whole load
    svg << "<rect x=\"" << left << "\" y=\"" << top << "\" width=\"" << axes.x(loaded->step) - left << "\" height=\""
        << height - top - bottom << "\" fill=\"#eef2f7\"/>\n";
    text(svg, left + 8, height - bottom - 10, "start", "loading");
  }
  draw_frame(svg, axes, "");
  draw_key(svg, left, "#1f5fa8", "bound of the remaining error, mm");
  draw_key(svg, left + 250, "#c2571a", "residual / force");
  if (tolerance > 0) {
    svg << "<line x1=\"" << left << "\" x2=\"" << width - right << "\" y1=\"" << axes.y(tolerance) << "\" y2=\""
        << axes.y(tolerance) << "\" stroke=\"#b3261e\" stroke-dasharray=\"6 4\"/>\n";
    text(svg, left + 8, axes.y(tolerance) - 6, "start", "tolerance, mm");
  }
  draw_curve(svg, axes, history, step_of, &Row::residual, "#c2571a");
  draw_curve(svg, axes, history, step_of, &Row::error_bound, "#1f5fa8");
  svg << "</svg>\n";
  return svg.str();
}

std::string energy_plot(const std::vector<Row>& history, solve::Dynamics dynamics) {
  struct Curve {
    const char* name;
    const char* stroke;
    double Row::*value;
  };
  constexpr Curve curves[] = {{"external work", "#1f5fa8", &Row::external_work},
                              {"strain energy", "#c2571a", &Row::strain_energy},
                              {"kinetic energy", "#7a7f87", &Row::kinetic_energy},
                              {"dissipated", "#3d8a52", &Row::dissipated_energy}};
  const bool in_time = dynamics == solve::Dynamics::transient;
  const Value place = in_time ? Value(&Row::time) : Value(step_of);
  double high = 0;
  for (const Row& row : history) {
    for (const Curve& curve : curves) {
      high = std::isfinite(row.*curve.value) ? std::max(high, row.*curve.value) : high;
    }
  }
  if (history.size() < 2 || high == 0) {
    return {};
  }
  const Axes axes{.x_name = in_time ? "time, s" : "step",
                  .x_high = place(history.back()),
                  .y_low = 0,
                  .y_high = round_up(high),
                  .logarithmic = false};
  std::ostringstream svg = begin_svg(in_time ? "energies over time" : "energies over the steps");
  draw_frame(svg, axes, "energy, mJ");
  double key = left + 30;
  for (const Curve& curve : curves) {
    draw_curve(svg, axes, history, place, curve.value, curve.stroke);
    draw_key(svg, key, curve.stroke, curve.name);
    key += 118;
  }
  svg << "</svg>\n";
  return svg.str();
}

}  // namespace brainshift::pipelines
