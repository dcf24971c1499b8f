// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve {

/// A cube held below; its upper face is measured to sink in the middle, each node by itself.
inline Model measured_box(double sigma) {
  Model model = box_model(test::box_cells(6, model_side));
  hold_bottom(model);
  std::vector<Eigen::Triplet<double>> share;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    if (x[2] > model_side - 1e-9 && (x.head<2>().array() - model_side / 2).matrix().norm() < 25) {
      model.conditions.displacement.row(a) << 0, 0, -4;
      share.emplace_back(static_cast<int>(a), static_cast<int>(share.size()), 1.0);
    }
  }
  Measurement& measured = model.conditions.measured.emplace();
  const auto points = static_cast<Eigen::Index>(share.size());
  measured.spread.resize(model.cloud.positions.rows(), points);
  measured.spread.setFromTriplets(share.begin(), share.end());
  measured.sigma = Points::Constant(points, 3, sigma);
  measured.cortex.resize(points, 3);
  measured.cortex_displacement.resize(points, 3);
  for (const auto& entry : share) {
    measured.cortex.row(entry.col()) = model.cloud.positions.row(entry.row());
    measured.cortex_displacement.row(entry.col()) = model.conditions.displacement.row(entry.row());
  }
  measured.inner = measured.inner_displacement = measured.inner_sigma = Points(0, 3);
  return model;
}

/// Linear shape functions, to 0.002 mm.
inline SolveOptions linear_options() {
  SolveOptions options;
  options.shape.basis = Basis::linear;
  options.tolerance = 0.002;
  return options;
}

/// With points inside, each measured to have moved sideways.
inline Model with_inner(Model model, int points) {
  Measurement& measured = *model.conditions.measured;
  measured.inner = Points::Constant(points, 3, model_side / 2);
  measured.inner_displacement = Points::Zero(points, 3);
  measured.inner_sigma = Points::Constant(points, 3, 0.2);
  for (int i = 0; i < points; ++i) {
    measured.inner(i, 0) += 15 * i;
    measured.inner_displacement(i, 0) = 1 + i;
  }
  return model;
}

/// The same springs whatever was measured: no smooth motion.
inline Model with_weight(Model model, double weight) {
  model.conditions.measured->weight = weight;
  return model;
}

/// As if it had been measured without noise.
inline Model without_noise(Model model) {
  model.conditions.measured.reset();
  return model;
}

}  // namespace brainshift::solve
