// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/resampling_field.hpp"

#include <Eigen/LU>
#include <array>
#include <vector>

#include "register/field/field_sampler.hpp"

namespace brainshift::registration {

namespace {

constexpr int most_steps = 40;
constexpr int most_halvings = 6;
constexpr double stop_fraction = 0.02;  // of the tolerance: Newton's last step is cheap and gains more than this

struct Inverse {
  Eigen::Vector3d displacement;
  double residual;  ///< |d + u(y + d)|, mm
};

/// Newton's step, or the fixed point's where the map is folded and Newton's would lead astray.
Eigen::Vector3d step_from(const Eigen::Vector3d& residual, const Eigen::Matrix3d& gradient) {
  const Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity() + gradient;
  const double determinant = jacobian.determinant();
  if (!(determinant > 0.02)) {
    return -residual;
  }
  return -(jacobian.inverse() * residual);
}

/// Solves d + u(y + d) = 0 from a first guess. The residual falls at each step: a step that would raise it is halved.
Inverse invert_at(const FieldSampler& forward, const Eigen::Vector3d& y, const Eigen::Vector3d& guess, double stop) {
  const Eigen::Matrix3d& to_voxels = forward.index_from_world();
  Eigen::Matrix3d by_index;
  Eigen::Vector3d d = guess;
  Eigen::Vector3d residual = d + forward.value_and_gradient(y + to_voxels * d, by_index);
  for (int n = 0; n < most_steps && residual.norm() > stop; ++n) {
    Eigen::Vector3d step = step_from(residual, by_index * to_voxels);
    Eigen::Vector3d next = residual;
    for (int halving = 0; halving < most_halvings; ++halving) {
      next = d + step + forward.value_and_gradient(y + to_voxels * (d + step), by_index);
      if (next.norm() < residual.norm()) {
        break;
      }
      step /= 2;
    }
    d += step;
    residual = next;
  }
  return {d, residual.norm()};
}

}  // namespace

InvertedField resampling_field(const VectorImage& forward, double tolerance) {
  const ImageGeometry& g = forward.geometry;
  const FieldSampler sampler(forward);
  InvertedField result{{g, std::vector<std::array<float, 3>>(g.voxel_count(), std::array<float, 3>{0, 0, 0})}, 0};
  std::size_t missed = 0;
#pragma omp parallel for schedule(dynamic, 1) reduction(+ : missed)
  for (int k = 0; k < g.size.z(); ++k) {
    for (int j = 0; j < g.size.y(); ++j) {
      Eigen::Vector3d guess = Eigen::Vector3d::Zero();
      for (int i = 0; i < g.size.x(); ++i) {
        const std::array<float, 3>& u = forward.at(i, j, k);
        if (u == std::array<float, 3>{0, 0, 0}) {
          guess.setZero();
          continue;
        }
        const Inverse found = invert_at(sampler, Eigen::Vector3d(i, j, k), guess, stop_fraction * tolerance);
        missed += found.residual <= tolerance ? 0 : 1;
        guess = found.displacement;
        result.field.at(i, j, k) = stored(guess);
      }
    }
  }
  result.not_inverted = missed;
  return result;
}

}  // namespace brainshift::registration
