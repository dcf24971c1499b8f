// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/place_map.hpp"

#include <Eigen/LU>

namespace brainshift::registration {

namespace {

constexpr double reach = 0.5;  // of the differences, mm: of the order of a voxel, so that they see no kink alone

/// ∂map/∂place; the identity along an axis where the map is not known on both sides.
Eigen::Matrix3d gradient_at(const PlaceMap& map, const Eigen::Vector3d& y) {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = reach * Eigen::Vector3d::Unit(axis);
    const auto ahead = map(y + step), behind = map(y - step);
    if (ahead && behind) {
      gradient.col(axis) = (*ahead - *behind) / (2 * reach);
    }
  }
  return gradient;
}

}  // namespace

std::optional<Eigen::Vector3d> inverse_at(const PlaceMap& map, const Eigen::Vector3d& x) {
  constexpr double tolerance = 1e-3;  // mm, far below a voxel
  constexpr int most_steps = 40, most_halvings = 6;
  Eigen::Vector3d y = x;
  std::optional<Eigen::Vector3d> there = map(y);
  for (int n = 0; there; ++n) {
    const Eigen::Vector3d off = *there - x;
    if (off.norm() <= tolerance) {
      return y;
    }
    if (n == most_steps) {
      break;
    }
    const Eigen::Matrix3d gradient = gradient_at(map, y);
    constexpr double folds = 0.02;  // of the determinant: there Newton's step would lead astray
    Eigen::Vector3d step = gradient.determinant() > folds ? Eigen::Vector3d(-gradient.inverse() * off) : -off;
    std::optional<Eigen::Vector3d> next;
    for (int halving = 0;; ++halving) {
      next = map(y + step);
      if ((next && (*next - x).norm() < off.norm()) || halving == most_halvings) {
        break;
      }
      step /= 2;
    }
    y += step;
    there = next;
  }
  return std::nullopt;
}

}  // namespace brainshift::registration
