// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "register/field/field_grid.hpp"
#include "segmentation/geometry/on_device.hpp"

namespace brainshift::registration {

struct Inverse {
  Eigen::Vector3d displacement;
  double residual;  ///< |d + u(y + d)|, mm
};

/// Newton's step, or the fixed point's where the map is folded and Newton's would lead astray.
BRAINSHIFT_ON_DEVICE inline Eigen::Vector3d step_from(const Eigen::Vector3d& residual,
                                                      const Eigen::Matrix3d& gradient) {
  const Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity() + gradient;
  const double determinant = jacobian.determinant();
  if (!(determinant > 0.02)) {
    return -residual;
  }
  return -(jacobian.inverse() * residual);
}

/// Solves d + u(y + d) = 0 from a first guess; y: an index. A step that would raise the residual is halved. Where that
/// does not help a small one is taken all the same: it leads out of many folds, and where it ended there three times as
/// many places were missed.
BRAINSHIFT_ON_DEVICE inline Inverse invert_at(const FieldGrid& forward, const Eigen::Vector3d& y,
                                              const Eigen::Vector3d& guess, double stop) {
  constexpr int most_steps = 40, most_halvings = 6;
  const Eigen::Matrix3d& to_voxels = forward.index_from_world;
  Eigen::Matrix3d by_index;
  Eigen::Vector3d d = guess;
  Eigen::Vector3d residual = d + forward.value_and_gradient(y + to_voxels * d, by_index);
  for (int n = 0; n < most_steps && residual.norm() > stop; ++n) {
    Eigen::Vector3d step = step_from(residual, by_index * to_voxels);
    Eigen::Vector3d next = residual;
    for (int halving = 0;; ++halving) {
      next = d + step + forward.value_and_gradient(y + to_voxels * (d + step), by_index);
      if (next.norm() < residual.norm() || halving == most_halvings) {
        break;
      }
      step /= 2;
    }
    d += step;
    residual = next;
  }
  return {d, residual.norm()};
}

/// Inverts a row of voxels along x, each from what the voxel before it has found. Returns how many missed the
/// tolerance. What does not move is left as it is.
template <class Store>
BRAINSHIFT_ON_DEVICE std::size_t invert_row(const FieldGrid& forward, int j, int k, double tolerance,
                                            const Store& store) {
  constexpr double stop_fraction = 0.02;  // of the tolerance: Newton's last step is cheap and gains more than this
  const auto nx = static_cast<std::size_t>(forward.size[0]), ny = static_cast<std::size_t>(forward.size[1]);
  const std::size_t first = nx * (static_cast<std::size_t>(j) + ny * static_cast<std::size_t>(k));
  std::size_t missed = 0;
  Eigen::Vector3d guess = Eigen::Vector3d::Zero();
  for (int i = 0; i < forward.size[0]; ++i) {
    const std::size_t offset = first + static_cast<std::size_t>(i);
    const std::array<float, 3>& u = forward.voxels[offset];
    if (u[0] == 0 && u[1] == 0 && u[2] == 0) {
      guess.setZero();
      continue;
    }
    const Inverse found = invert_at(forward, Eigen::Vector3d(i, j, k), guess, stop_fraction * tolerance);
    missed += found.residual <= tolerance ? 0 : 1;
    guess = found.displacement;
    store(offset, stored(guess));
  }
  return missed;
}

}  // namespace brainshift::registration
