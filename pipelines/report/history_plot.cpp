// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/history_plot.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace brainshift::pipelines {

namespace {

using Row = solve::HistoryRow;
using Value = std::function<double(const Row&)>;

double step_of(const Row& row) {
  return row.step;
}

Series series_of(const std::string& name, const std::vector<Row>& history, const Value& x, const Value& y) {
  Series series{.name = name, .x = {}, .y = {}};
  for (const Row& row : history) {
    series.x.push_back(x(row));
    series.y.push_back(y(row));
  }
  return series;
}

std::optional<Plot> unless_empty(Plot plot) {
  const auto positive = [](const Series& series) {
    return series.y.size() > 1 && std::ranges::any_of(series.y, [](double y) { return std::isfinite(y) && y > 0; });
  };
  return std::ranges::any_of(plot.series, positive) ? std::optional(std::move(plot)) : std::nullopt;
}

}  // namespace

std::optional<Plot> convergence_plot(const std::vector<Row>& history, double tolerance) {
  Plot plot{.file = "convergence",
            .title = "Convergence",
            .x_label = "step",
            .y_label = "",
            .series = {series_of("bound of the remaining error, mm", history, step_of, &Row::error_bound),
                       series_of("residual / force", history, step_of, &Row::residual)},
            .scale = Scale::log_y};
  const auto loaded = std::ranges::find_if(history, [](const Row& row) { return row.time >= 1; });
  if (loaded != history.begin() && loaded != history.end()) {  // a coarse start is under the whole load
    plot.phase = ShadedPart{.from = step_of(history.front()), .to = step_of(*loaded), .name = "loading"};
  }
  if (tolerance > 0) {
    plot.level = DashedLine{.y = tolerance, .name = "tolerance, mm"};
  }
  return unless_empty(std::move(plot));
}

std::optional<Plot> energy_plot(const std::vector<Row>& history, solve::Dynamics dynamics) {
  const bool in_time = dynamics == solve::Dynamics::transient;
  const Value x = in_time ? Value(&Row::time) : Value(step_of);
  return unless_empty({.file = "energies",
                       .title = "Energies",
                       .x_label = in_time ? "time, s" : "step",
                       .y_label = "energy, mJ",
                       .series = {series_of("external work", history, x, &Row::external_work),
                                  series_of("strain energy", history, x, &Row::strain_energy),
                                  series_of("kinetic energy", history, x, &Row::kinetic_energy),
                                  series_of("dissipated", history, x, &Row::dissipated_energy)}});
}

}  // namespace brainshift::pipelines
