// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/interface/model.hpp"

namespace brainshift::solve {

/// Nodes at z = 0 do not move.
inline void hold_bottom(Model& model) {
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 2) < 1e-9) {
      model.conditions.displacement.row(a).setZero();
    }
  }
}

}  // namespace brainshift::solve
