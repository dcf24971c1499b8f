// SPDX-License-Identifier: GPL-3.0-or-later
//
// Materials at the ends: nearly incompressible, and a million times stiffer than their neighbour.
#include <cmath>
#include <sstream>

#include "tests/extremes/block.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/material_cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::extremes::stiffness_cases {

namespace {

Row free_block(double poisson_ratio, int n) {
  constexpr double side = 60;
  const Block block{Eigen::Vector3d::Constant(side), 0.7, {3000, poisson_ratio, 1000}};
  solve::SolveOptions options;
  options.max_steps = 500000;
  const Ending ending = run(block.model(test::irregular_box(n, side), test::box_cells(n - 1, side)), options);
  std::ostringstream name;
  name << "ν = " << poisson_ratio << ", block to 70 %, sides free";
  return judge(name.str(), Must::answer, ending, block.errors(ending.result, 0.2, 1), on_paper);
}

/// µ is 1000 Pa in all: the force of the reference at 0.499 is the incompressible one to half a percent.
Row bonded_cylinder(double poisson_ratio, const std::string& reference_name, double least_distance, double most) {
  const auto reference = verification::read_reference(reference_name, reference_name + "_force");
  const solve::Model model =
      verification::cylinder_model(least_distance, 2, poisson_ratio, {0, 0, -reference.travel.back()});
  solve::SolveOptions options;
  options.max_steps = 500000;
  const Ending ending = run(model, options);
  const auto& history = ending.result.history;
  const double force = history.empty() ? std::nan("") : std::abs(history.back().reaction[2]);
  std::ostringstream name;
  name << "ν = " << poisson_ratio << ", cylinder pressed by 20 %, faces bonded";
  return judge(name.str(), Must::answer, ending,
               {{"force off by", 100 * std::abs(force / reference.converged_force - 1), most, "%"}},
               std::to_string(model.cloud.size()) + " nodes; " + reference_name + ".csv");
}

constexpr double width = 15, height = 60;  // mm

/// Layers of equal height on each other, in a box that they cannot leave sideways.
solve::Model layered(const std::vector<solve::Material>& layers, double pressed, double least_distance) {
  solve::Model model;
  model.cloud = verification::box_cloud({width, width, height}, least_distance, 3);
  model.conditions = test::all_free(model.cloud);
  const int across = static_cast<int>(width / least_distance);
  model.cells = test::box_cells({across, across, 12 * (across / 3)}, {width, width, height});
  const auto layer_of = [&](double z) {
    return std::min(static_cast<std::size_t>(static_cast<double>(layers.size()) * z / height), layers.size() - 1);
  };
  for (std::size_t c = 0; c < model.cells.size(); ++c) {
    const double low = model.cells.vertices(model.cells.connectivity[8 * c], 2);
    const double high = model.cells.vertices(model.cells.connectivity[8 * c + 6], 2);
    model.cells.label[c] = static_cast<std::int32_t>(layer_of((low + high) / 2)) + 1;
  }
  for (std::size_t i = 0; i < layers.size(); ++i) {
    model.materials[static_cast<std::int32_t>(i) + 1] = layers[i];
  }
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    auto prescribed = model.conditions.displacement.row(a);
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    for (int axis = 0; axis < 2; ++axis) {
      if (x[axis] == 0 || x[axis] == width) {
        prescribed[axis] = 0;
      }
    }
    if (x[2] == 0 || x[2] == height) {
      prescribed[2] = x[2] == 0 ? 0 : -pressed;
    }
  }
  return model;
}

double axial_stress(const solve::Material& material, double stretch) {
  return solve::stress(solve::elastic_law(material), Eigen::Vector3d(1, 1, stretch).asDiagonal())(2, 2);
}

/// The stretch under a stress, by bisection.
double stretch_under(const solve::Material& material, double stress) {
  double low = 0.01, high = 1;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (axial_stress(material, middle) < stress ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// The stress that all layers carry, Pa, and their stretches.
std::pair<double, std::vector<double>> layers_on_paper(const std::vector<solve::Material>& layers, double pressed) {
  double low = axial_stress(layers[0], 0.05), high = 0;
  std::vector<double> stretch(layers.size());
  for (int i = 0; i < 200; ++i) {
    const double stress = (low + high) / 2;
    double shorter = 0;
    for (std::size_t k = 0; k < layers.size(); ++k) {
      stretch[k] = stretch_under(layers[k], stress);
      shorter += (1 - stretch[k]) * height / static_cast<double>(layers.size());
    }
    (shorter > pressed ? low : high) = stress;
  }
  return {low, stretch};
}

Row layers_row(const std::vector<double>& ratios, double poisson_ratio, double pressed, double least_distance,
               double most_force) {
  std::vector<solve::Material> layers;
  std::ostringstream name;
  name << "layers of stiffness";
  for (const double ratio : ratios) {
    layers.push_back({3000 * ratio, poisson_ratio, 1000});
    name << (layers.size() > 1 ? " : " : " ") << ratio;
  }
  name << ", ν = " << poisson_ratio << ", confined";
  const solve::Model model = layered(layers, pressed, least_distance);
  solve::SolveOptions options;
  options.max_steps = 500000;
  const Ending ending = run(model, options);
  const auto [stress, stretch] = layers_on_paper(layers, pressed);
  const auto& history = ending.result.history;
  const double force = history.empty() ? std::nan("") : 1e6 * history.back().reaction[2] / (width * width);
  double off = 0;
  const Points& x = ending.result.solution.positions;
  for (Eigen::Index a = 0; a < x.rows(); ++a) {
    const double thick = height / static_cast<double>(layers.size());
    double sunk = 0;
    for (std::size_t k = 0; k < layers.size(); ++k) {
      sunk += (stretch[k] - 1) * std::clamp(x(a, 2) - static_cast<double>(k) * thick, 0.0, thick);
    }
    off = std::max(off, (ending.result.solution.displacement.row(a) - Eigen::RowVector3d(0, 0, sunk)).norm());
  }
  return judge(name.str(), Must::answer, ending,
               {{"force off by", 100 * std::abs(force / stress - 1), most_force, "%"},
                {"displacement by", 100 * off / pressed, 2 * most_force, "% of the imposed"}},
               "layers in series, on paper; nodes " + std::to_string(least_distance).substr(0, 3) + " mm apart");
}

}  // namespace

std::vector<Row> incompressible(bool small) {
  std::vector<Row> rows;
  for (const double poisson_ratio : {0.49, 0.499, 0.4999}) {
    rows.push_back(free_block(poisson_ratio, small ? 5 : 7));
  }
  const double distance = small ? 18 : 12, most = small ? 9 : 5;
  rows.push_back(bonded_cylinder(0.49, "cylinder_compression", distance, most));
  rows.push_back(bonded_cylinder(0.499, "cylinder_compression_nu0499", distance, most));
  rows.push_back(bonded_cylinder(0.4999, "cylinder_compression_nu0499", distance, most));
  return rows;
}

/// Shape functions are smooth across the border of two tissues, the strain is not: an error of the first order in the
/// distance of the nodes over the thickness of the soft layer.
std::vector<Row> stiffness_ratio(bool small) {
  const double h = small ? 5 : 2.5, most = small ? 50 : 20;
  return {layers_row({1, 1e3}, 0.3, 3, h, most), layers_row({1, 1e6}, 0.3, 3, h, most),
          layers_row({1, 1e3, 1e6}, 0.3, 3, h, most), layers_row({1}, 0.3, 3, h, most),
          layers_row({1}, 0.49, 0.6, h, most)};
}

}  // namespace brainshift::extremes::stiffness_cases
