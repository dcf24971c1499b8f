// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

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

/// The derivatives along the first `axes` axes are those of the values, by central differences.
inline void expect_derivatives_of_values(const solve::ShapeFunctions& shape, const Points& nodes, const Points& at,
                                         int axes) {
  const Points values = nodes.array().sin().matrix();  // anything rough
  const solve::ShapeRows rows = shape.evaluate(at, true);
  constexpr double step = 1e-5;
  for (int axis = 0; axis < axes; ++axis) {
    Points ahead = at, behind = at;
    ahead.col(axis).array() += step;
    behind.col(axis).array() -= step;
    const Points difference = (shape.interpolate(ahead, values) - shape.interpolate(behind, values)) / (2 * step);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const solve::ShapeRow row = rows[i];
      Eigen::RowVector3d slope = Eigen::RowVector3d::Zero();
      for (std::size_t k = 0; k < row.size(); ++k) {
        slope += row.gradient(k)[axis] * values.row(row.node[k]);
      }
      EXPECT_LE((slope - difference.row(static_cast<Eigen::Index>(i))).norm(), 1e-6);
    }
  }
}

}  // namespace brainshift::test
