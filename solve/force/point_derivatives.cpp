// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/point_derivatives.hpp"

namespace brainshift::solve {

Eigen::Matrix3Xd derivatives(const PointBlocks& points, std::int32_t point) {
  const auto nodes = static_cast<Eigen::Index>(points.support_size(point));
  if (points.precision() == Precision::single_precision) {
    return Eigen::Map<const Eigen::Matrix3Xf>(points.derivatives_of<float>(point), 3, nodes).cast<double>();
  }
  return Eigen::Map<const Eigen::Matrix3Xd>(points.derivatives_of<double>(point), 3, nodes);
}

std::vector<double> column_norms(const Eigen::Matrix3Xd& b) {
  const Eigen::VectorXd norms = b.colwise().norm();
  return {norms.begin(), norms.end()};
}

}  // namespace brainshift::solve
