// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the bases make of clouds on which quadratic MLS has no or hardly a solution: as measured, without bounds.
#include <cmath>
#include <exception>
#include <limits>

#include "segmentation/geometry/neighbour_distance.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/verification/cases/cases.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::verification::singular_clouds_cases {

namespace {

constexpr double side = 50;  // mm

/// An irregular box squeezed to layers that are flat in z but for `roughness` mm.
NodeCloud layers(int count, double apart, double roughness) {
  NodeCloud cloud = test::irregular_box(11, side);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    if (a / 121 < count) {
      kept.push_back(a);
    }
  }
  const Points positions = cloud.positions(kept, Eigen::all);
  const double h = side / 10;
  cloud.positions = positions;
  for (Eigen::Index a = 0; a < positions.rows(); ++a) {
    const double layer = std::floor(static_cast<double>(a) / 121);
    cloud.positions(a, 2) = apart * layer + roughness * (positions(a, 2) / h - layer);
  }
  cloud.spacing = mean_neighbour_distance(nearest_neighbours(cloud.positions, 6), 6);
  return cloud;
}

Points smooth_field(const Points& x) {
  constexpr double wave = 0.06;  // 1/mm
  Points field(x.rows(), 3);
  field.col(0) = (wave * x.col(1)).array().sin();
  field.col(1) = (wave * x.col(0)).array().cos() + 0.02 * x.col(2).array();
  field.col(2) = (wave * (x.col(0) + x.col(1))).array().sin();
  return field;
}

struct Behaviour {
  double error = std::numeric_limits<double>::quiet_NaN();  ///< of interpolating the smooth field, %
  double support = std::numeric_limits<double>::quiet_NaN();
  double grown = std::numeric_limits<double>::quiet_NaN();  ///< supports, %
  std::string refused = {};
};

Behaviour behaviour(const NodeCloud& cloud, Basis basis) {
  const double top = cloud.positions.col(2).maxCoeff();
  Points at = test::random_points(1000, 1, 3);
  at = (at * Eigen::Vector3d(side, side, top).asDiagonal()).eval();
  try {
    const solve::ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = basis});
    const solve::ShapeRows rows = shape.evaluate(at, true);
    const Points parameters =
        solve::parameters_from_displacement(shape, cloud.positions, smooth_field(cloud.positions));
    const Points exact = smooth_field(at);
    return {100 * (shape.interpolate(at, parameters) - exact).norm() / exact.norm(),
            static_cast<double>(rows.node.size()) / static_cast<double>(rows.size()),
            100 * static_cast<double>(rows.grown) / static_cast<double>(rows.size())};
  } catch (const std::exception& refused) {
    return {.refused = refused.what()};
  }
}

}  // namespace

Outcome singular_clouds(bool) {
  Outcome outcome;
  for (const auto& [cloud_name, cloud] : {std::pair{"irregular box", test::irregular_box(11, side)},
                                          {"three layers", layers(3, 5, 0)},
                                          {"two layers, 0.5 mm rough", layers(2, 5, 0.5)},
                                          {"two flat layers", layers(2, 5, 0)}}) {
    for (const auto& [basis_name, basis] : {std::pair{"linear MLS", Basis::linear},
                                            {"quadratic MLS", Basis::quadratic},
                                            {"MMLS", Basis::modified_quadratic}}) {
      const Behaviour b = behaviour(cloud, basis);
      const std::string row = std::string(cloud_name) + ", " + basis_name + ": ";
      const std::string how = b.refused.empty() ? "analytic" : "refused: " + b.refused;
      outcome.figures.push_back({row + "error of a smooth field", "", b.error, "%", {}, {}, how});
      outcome.figures.push_back({row + "nodes a support", "", b.support, "", {}, {}, how});
      outcome.figures.push_back({row + "supports that had to grow", "", b.grown, "%", {}, {}, how});
    }
  }
  return outcome;
}

}  // namespace brainshift::verification::singular_clouds_cases
