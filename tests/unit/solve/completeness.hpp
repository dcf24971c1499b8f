// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "discretise/interface/node_cloud.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::test {

/// Largest errors of Σφ − 1, Σφ X − x, Σ∇φ and Σ X∇φ − 1 (in the plane, without z), the last two
/// times a length of 1 spacing.
inline double completeness_error(const NodeCloud& cloud, const Points& at, const ShapeOptions& options) {
  const solve::ShapeRows rows = solve::ShapeFunctions(cloud.positions, cloud.spacing, options).evaluate(at, true);
  Eigen::Matrix3d complete = Eigen::Matrix3d::Identity();
  complete(2, 2) = options.planar ? 0 : 1;
  double worst = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double sum = 0;
    Eigen::RowVector3d place = Eigen::RowVector3d::Zero(), slope = place;
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    const Eigen::RowVector3d x = at.row(static_cast<Eigen::Index>(i));
    for (auto k = static_cast<std::size_t>(rows.begin[i]); k < static_cast<std::size_t>(rows.begin[i + 1]); ++k) {
      const Eigen::RowVector3d away = cloud.positions.row(rows.node[k]) - x;
      const Eigen::RowVector3d b(&rows.derivative[3 * k]);
      sum += rows.value[k];
      place += rows.value[k] * away;
      slope += b;
      gradient += away.transpose() * b;
    }
    const double h = cloud.spacing[0];
    worst = std::max({worst, std::abs(sum - 1), place.norm() / h, slope.norm() * h, (gradient - complete).norm()});
  }
  return worst;
}

}  // namespace brainshift::test
