// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/interface/conditions.hpp"

namespace brainshift::solve {

/// Each node is measured by itself, with a noise that differs from axis to axis: so do the components' inverses.
inline Measurement noisy_nodes(Eigen::Index nodes, double weight) {
  Measurement measured;
  measured.spread.resize(nodes, nodes);
  measured.spread.setIdentity();
  measured.sigma = Points::Constant(nodes, 3, 0.5);
  measured.sigma.col(1).setConstant(0.8);
  measured.weight = weight;
  return measured;
}

}  // namespace brainshift::solve
