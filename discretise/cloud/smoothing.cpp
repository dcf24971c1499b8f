// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/smoothing.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "discretise/cloud/delaunay.hpp"

namespace brainshift::discretise {

void smooth(Points& nodes, Eigen::Index first, const Scanlines& body, const SizingField& sizing) {
  Points sum = Points::Zero(nodes.rows(), 3);
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(nodes.rows());
  for (const auto& corners : delaunay_tetrahedra(nodes)) {
    Eigen::Matrix<double, 4, 3> x;
    for (int k = 0; k < 4; ++k) {
      x.row(k) = nodes.row(corners[static_cast<std::size_t>(k)]);
    }
    const Eigen::RowVector3d middle = x.colwise().mean();
    const Eigen::Matrix3d edges = x.bottomRows<3>().rowwise() - x.row(0);
    // Nodes at rest have edges proportional to the field when the density goes with its -(3 + 1)th power.
    const double w = edges.determinant() / std::pow(sizing.factor(middle.transpose()), 4);
    for (const std::int32_t node : corners) {
      sum.row(node) += w * middle;
      weight[node] += w;
    }
  }
  for (Eigen::Index node = first; node < nodes.rows(); ++node) {
    if (!(weight[node] > 0)) {
      continue;
    }
    const Eigen::Vector3d moved = (sum.row(node) / weight[node]).transpose();
    if (body.inside(moved)) {
      nodes.row(node) = moved.transpose();
    }
  }
}

}  // namespace brainshift::discretise
