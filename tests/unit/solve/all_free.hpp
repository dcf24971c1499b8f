// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "solve/interface/conditions.hpp"

namespace brainshift::test {

/// Nothing prescribed at any node: a row a node, to write into.
inline solve::Conditions all_free(const NodeCloud& cloud) {
  return {.displacement = Points::Constant(cloud.positions.rows(), 3, std::nan(""))};
}

}  // namespace brainshift::test
