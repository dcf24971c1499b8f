// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/smoothing.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "discretise/cloud/delaunay.hpp"
#include "discretise/cloud/tetrahedron.hpp"

namespace brainshift::discretise {
namespace {

/// A flatter tetrahedron is a sliver.
constexpr double sliver_quality = 0.12;
/// How far a sliver's node is moved, in its edges.
constexpr double shake = 0.1;

Eigen::Vector3d random_direction(Random& random) {
  const double z = 2 * random.uniform() - 1;
  const double angle = 2 * std::numbers::pi * random.uniform();
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace

void smooth(Points& nodes, Eigen::Index first, const Scanlines& body, const SizingField& sizing) {
  Points sum = Points::Zero(nodes.rows(), 3);
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(nodes.rows());
  for (const auto& corners : delaunay_tetrahedra(nodes)) {
    const TetrahedronCorners x = corners_of(nodes, corners);
    const Eigen::RowVector3d middle = x.colwise().mean();
    // Nodes at rest have edges proportional to the field when the density goes with its -(3 + 1)th power.
    const double w = volume_of(x) / std::pow(sizing.factor(middle.transpose()), 4);
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

void shake_slivers(Points& nodes, Eigen::Index first, const Scanlines& body, Random& random) {
  for (const auto& corners : delaunay_tetrahedra(nodes)) {
    const TetrahedronCorners x = corners_of(nodes, corners);
    if (shape_quality(x) > sliver_quality) {
      continue;
    }
    const std::size_t start = random.below(4);
    for (std::size_t k = start; k < start + 4; ++k) {
      const std::int32_t node = corners[k % 4];
      if (node >= first) {
        const Eigen::Vector3d moved = nodes.row(node).transpose() + shake * mean_edge(x) * random_direction(random);
        if (body.inside(moved)) {
          nodes.row(node) = moved.transpose();
        }
        break;
      }
    }
  }
}

}  // namespace brainshift::discretise
