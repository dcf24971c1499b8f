// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/weight_figure.hpp"

#include "pipelines/report/measure_table.hpp"
#include "pipelines/report/plot.hpp"

namespace brainshift::pipelines {

std::vector<Figure> weight_figures(const nlohmann::json& measures) {
  if (!measures.contains("weights")) {
    return {};
  }
  const double taken = measures.value("weight_mJ", 0.0);
  Series all{.name = "weights that were tried", .x = {}, .y = {}};
  Series one{.name = "the one that was taken, " + readable(taken) + " mJ", .x = {}, .y = {}, .joined = false};
  const auto add = [](const nlohmann::json& row, Series& series) {
    series.x.push_back(row.value("energy_mJ", 0.0));
    series.y.push_back(row.value("misfit", 0.0));
  };
  for (const auto& row : measures["weights"]) {
    add(row, all);
    if (row.value("weight_mJ", 0.0) == taken) {
      add(row, one);
    }
  }
  const Plot plot{.file = "weights",
                  .title = "What the measured points ask of the tissue",
                  .x_label = "energy of the deformation, mJ",
                  .y_label = "misfit: sum of squares over the variances of the noise",
                  .series = {all, one},
                  .scale = Scale::log_log};
  return {{.name = plot.file, .width = plot_width, .height = plot_height, .svg = plot_svg(plot)}};
}

}  // namespace brainshift::pipelines
