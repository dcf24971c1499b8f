// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/interface/model.hpp"

namespace brainshift::test {

/// All nodes of the surface are to move by H·x.
inline void move_surface(solve::Model& model, const Eigen::Matrix3d& h) {
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.on_surface[static_cast<std::size_t>(a)] != 0) {
      model.conditions.displacement.row(a) = model.cloud.positions.row(a) * h.transpose();
    }
  }
}

}  // namespace brainshift::test
