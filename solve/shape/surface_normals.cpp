// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/surface_normals.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <limits>

#include "segmentation/geometry/point_tree.hpp"

namespace brainshift::solve {

namespace {

constexpr double off_plane = 10;        // distance across a triangle's plane counts so many times that along it
constexpr std::size_t candidates = 12;  // nodes that are nearest in space
constexpr double piece_size = 0.5;      // longest edge of a piece of a triangle, over the spacing of the nodes
constexpr double farthest = 1.5;        // of a node from a piece that it takes, over its spacing
constexpr double same_place = 0.01;     // distance over the spacing
constexpr double least_second = 0.05;   // share of the largest eigenvalue from which a direction counts: tan²(13°)

/// Halves a triangle across its longest edge until it is small.
template <class Take>
void split(const Triangle& whole, double longest, const Take& take) {
  const std::array<Eigen::Vector3d, 3> v{whole.a, whole.b, whole.c};
  std::size_t edge = 0;
  double length = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double l = (v[(i + 1) % 3] - v[i]).norm();
    if (l > length) {
      length = l;
      edge = i;
    }
  }
  if (length <= longest) {
    take(whole);
    return;
  }
  const Eigen::Vector3d &a = v[edge], &b = v[(edge + 1) % 3], &c = v[(edge + 2) % 3];
  const Eigen::Vector3d middle = (a + b) / 2;
  split(Triangle{a, middle, c}, longest, take);
  split(Triangle{middle, b, c}, longest, take);
}

/// The node to which a piece belongs: one in its plane, though one across an edge may be nearer.
std::size_t node_of(const PointTree& tree, const Points& positions, const Eigen::Vector3d& centre,
                    const Eigen::Vector3d& normal) {
  std::array<std::size_t, candidates> index{};
  std::array<double, candidates> squared{};
  const std::size_t found = tree.nearest(centre.data(), candidates, index.data(), squared.data());
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < found; ++k) {
    const double across =
        off_plane * normal.dot(positions.row(static_cast<Eigen::Index>(index[k])).transpose() - centre);
    if (squared[k] + across * across < least) {
      least = squared[k] + across * across;
      best = index[k];
    }
  }
  return best;
}

/// Σ A n ⊗ n of the boundary's pieces over the nodes to which they belong.
using Spread = std::vector<Eigen::Matrix3d>;

void spread_over(const PointTree& tree, const Surface& boundary, const Points& positions,
                 std::span<const double> spacing, Spread& spread) {
  for (Eigen::Index t = 0; t < boundary.triangles.rows(); ++t) {
    const Triangle whole = triangle(boundary, t);
    const Eigen::Vector3d normal = whole.area_vector().normalized();
    const Eigen::Vector3d centroid = whole.centroid();
    const double near = spacing[tree.nearest(centroid.data()).first];
    split(whole, piece_size * near, [&](const Triangle& piece) {
      const Eigen::Vector3d centre = piece.centroid();
      const std::size_t node = node_of(tree, positions, centre, normal);
      if ((positions.row(static_cast<Eigen::Index>(node)).transpose() - centre).norm() <= farthest * spacing[node]) {
        spread[node] += piece.area_vector().norm() * normal * normal.transpose();
      }
    });
  }
}

/// A piece went to one of the nodes at a place.
Spread shared_at_one_place(const PointTree& tree, const Points& positions, std::span<const double> spacing,
                           const Spread& spread) {
  Spread shared = spread;
  std::array<std::size_t, candidates> index{};
  std::array<double, candidates> squared{};
  for (std::size_t node = 0; node < spread.size(); ++node) {
    const Eigen::RowVector3d place = positions.row(static_cast<Eigen::Index>(node));
    const std::size_t found = tree.nearest(place.data(), candidates, index.data(), squared.data());
    for (std::size_t k = 0; k < found; ++k) {
      if (index[k] != node && squared[k] <= same_place * same_place * spacing[node] * spacing[node]) {
        shared[node] += spread[index[k]];
      }
    }
  }
  return shared;
}

}  // namespace

SurfaceNormals surface_normals(std::span<const Surface> boundary, const Points& positions,
                               std::span<const double> spacing) {
  const PointTree tree(positions);
  Spread spread(spacing.size(), Eigen::Matrix3d::Zero());
  for (const Surface& part : boundary) {
    spread_over(tree, part, positions, spacing, spread);
  }
  SurfaceNormals normals;
  for (const Eigen::Matrix3d& moments : shared_at_one_place(tree, positions, spacing, spread)) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(moments);
    const Eigen::Vector3d& value = eigen.eigenvalues();  // ascending
    const auto counts = [&](int i) { return value[i] >= least_second * value[2]; };
    normals.rank.push_back(!counts(1) ? 1 : !counts(0) ? 2 : 3);
    normals.direction.push_back(eigen.eigenvectors().rowwise().reverse());
  }
  return normals;
}

}  // namespace brainshift::solve
