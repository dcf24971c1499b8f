// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "solve/interface/model.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/verification/clouds.hpp"

namespace brainshift::verification {

inline const Eigen::Vector3d block_size(60, 30, 60);  // mm

/// x where a sheet or cut through half of the block ends, z where it lies.
inline constexpr double block_rim = 30;

/// The block from 0 to block_size, finer at the rim, its lower face held and its upper one moved by `top`.
inline solve::Model block_model(double least_distance, const Eigen::RowVector3d& top) {
  solve::Model model;
  model.cloud = box_cloud(block_size, least_distance, 4, [](const Eigen::Vector3d& x) {
    return std::clamp(std::hypot(x.x() - block_rim, x.z() - block_rim) / 15, 0.6, 1.0);
  });
  model.conditions = test::all_free(model.cloud);
  const double edge = std::cbrt(block_size.prod() / (1.5 * static_cast<double>(model.cloud.size())));
  model.cells = test::box_cells((block_size / edge).array().round().cast<int>(), block_size);
  model.materials[1] = {3000, 0.49, 1000};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double z = model.cloud.positions(a, 2);
    if (z == 0) {
      model.conditions.displacement.row(a).setZero();
    } else if (z == block_size.z()) {
      model.conditions.displacement.row(a) = top;
    }
  }
  return model;
}

}  // namespace brainshift::verification
