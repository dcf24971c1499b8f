// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

#include "solve/solve.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/hold_bottom.hpp"
#include "tests/unit/solve/material_cases.hpp"
#include "tests/unit/solve/move_surface.hpp"

namespace brainshift::solve {

constexpr double model_side = 60;

/// A cube of n³ nodes, one material, nothing prescribed.
inline Model box_model(BackgroundCells cells, int n = 7) {
  Model model;
  model.cloud = test::irregular_box(n, model_side);
  model.conditions = test::all_free(model.cloud);
  model.cells = std::move(cells);
  model.materials[1] = {3000, 0.49, 1000};
  return model;
}

/// A cube stretched between frictionless plates, its sides free: the stretches are uniform.
inline Model uniaxial(double stretch, int n = 7) {
  Model model = box_model(test::box_cells(n - 1, model_side), n);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    auto prescribed = model.conditions.displacement.row(a);
    if (x[2] < 1e-9) {
      prescribed[2] = 0;
    }
    if (x[2] > model_side - 1e-9) {
      prescribed[2] = (stretch - 1) * model_side;
    }
    if (x[0] < 1e-9) {
      prescribed[0] = 0;
    }
    if (x[1] < 1e-9) {
      prescribed[1] = 0;
    }
  }
  return model;
}

/// Axial nominal stress and lateral stretch of uniaxial tension along z: lateral stress zero, by bisection.
inline std::pair<double, double> uniaxial_answer(const Material& material, double stretch) {
  const ElasticLaw law = elastic_law(material);
  const auto stress_at = [&](double lateral) {
    return stress(law, Eigen::Vector3d(lateral, lateral, stretch).asDiagonal());
  };
  double low = 0.5, high = 1.5;
  while (high - low > 1e-12) {
    const double middle = (low + high) / 2;
    (stress_at(middle)(0, 0) > 0 ? high : low) = middle;
  }
  return {stress_at(low)(2, 2), low};
}

/// Largest difference of the displacement from the linear field H·x over all nodes, mm.
inline double difference_from(const Solution& solution, const Eigen::Matrix3d& h) {
  return (solution.displacement - solution.positions * h.transpose()).rowwise().norm().maxCoeff();
}

/// Imposes H·x on the whole surface; the inner nodes should follow.
inline SolveResult patch_test(Model model, const SolveOptions& options, const Eigen::Matrix3d& h) {
  test::move_surface(model, h);
  return solve(model, options);
}

/// A cube of 4³ nodes that is stretched over `rise` seconds and held until `end`.
inline Model stretched(double stretch, double rise, double end) {
  Model model = uniaxial(stretch, 4);
  model.materials[1].poisson_ratio = 0.45;
  model.curve = end > rise ? LoadCurve({0, rise, end}, {0, 1, 1}, LoadCurve::Join::smooth)
                           : LoadCurve({0, rise}, {0, 1}, LoadCurve::Join::smooth);
  return model;
}

inline SolveOptions in_time(double damping = 0) {
  SolveOptions options;
  options.shape.basis = Basis::linear;
  options.dynamics = Dynamics::transient;
  options.damping = damping;
  return options;
}

}  // namespace brainshift::solve
