// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

#include "solve/solve.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/verification/clouds.hpp"

namespace brainshift::verification {

/// The cylinder of the references: 100 mm in diameter and height, both faces bonded, the lower held and the upper moved
/// by `travel`; µ = 1000 Pa, neo-Hookean. Irregular nodes, finer at the rims when rim_fineness is below 1; hexahedra
/// that do not conform.
inline solve::Model cylinder_model(double least_distance, double cells_per_node, double poisson_ratio,
                                   const Eigen::RowVector3d& travel, double rim_fineness = 1) {
  constexpr double radius = 50, height = 100, shear_modulus = 1000;
  solve::Model model;
  const Grading rims = rim_fineness < 1 ? Grading{{{radius, 0}, {radius, height}}, rim_fineness, 20} : Grading{};
  model.cloud = cylinder_cloud(radius, height, least_distance, 4, rims);
  model.conditions = test::all_free(model.cloud);
  model.boundary = cylinder_surface(radius, height);
  model.cells = cells_over(*model.boundary, model.cloud.size(), cells_per_node,
                           rims.rings.empty() ? std::nullopt : std::optional(refinement_about(rims, 5)));
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double z = model.cloud.positions(a, 2);
    if (z == 0) {
      model.conditions.displacement.row(a).setZero();
    } else if (z == height) {
      model.conditions.displacement.row(a) = travel;
    }
  }
  model.materials[1] = {2 * shear_modulus * (1 + poisson_ratio), poisson_ratio, 1000};
  return model;
}

/// Relaxation to a bound well below the differences to be measured.
inline solve::SolveOptions steady_options() {
  solve::SolveOptions options;
  options.tolerance = 0.003;
  options.start = solve::Start::coarse;  // which gives the estimate of the error, too
  return options;
}

/// Throws std::runtime_error with the solver's sentence when it failed.
inline solve::SolveResult solved(const solve::Model& model, const solve::SolveOptions& options) {
  solve::SolveResult result = solve::solve(model, options);
  if (!result.failure.empty()) {
    throw std::runtime_error(result.failure);
  }
  return result;
}

}  // namespace brainshift::verification
