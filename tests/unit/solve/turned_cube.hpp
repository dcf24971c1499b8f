// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve {

/// A cube that hangs from a small patch in the middle of a face, which is turned: the cube turns with it, unstrained.
inline Model turned_by_a_patch(const Eigen::Matrix3d& turn) {
  Model model = box_model(test::box_cells(8, model_side), 9);
  const Eigen::RowVector3d middle(model_side / 2, model_side / 2, 0);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d arm = model.cloud.positions.row(a) - middle;
    if (arm.norm() < 0.2 * model_side && arm.z() < 1e-9) {
      model.conditions.displacement.row(a) = arm * turn.transpose() - arm;
    }
  }
  return model;
}

/// Where its nodes are then, less where they were.
inline Points turn_of(const Points& positions, const Eigen::Matrix3d& turn) {
  const Points arms = positions.rowwise() - Eigen::RowVector3d(model_side / 2, model_side / 2, 0);
  return arms * turn.transpose() - arms;
}

}  // namespace brainshift::solve
