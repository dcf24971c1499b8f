// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/inside_body.hpp"

#include <cmath>
#include <vector>

#include "segmentation/geometry/point_tree.hpp"

namespace brainshift::solve {

namespace {

constexpr double alike = 1.5;  // ratio of lengths up to which cells count as cubes

/// What the axes are multiplied by, so that cells become cubes of the same volume.
Eigen::Array3d to_cubes(const Eigen::Array3d& lengths, bool planar) {
  const Eigen::Index axes = planar ? 2 : 3;
  const auto used = lengths.head(axes);
  Eigen::Array3d scale = Eigen::Array3d::Ones();
  if (used.maxCoeff() > alike * used.minCoeff()) {
    scale.head(axes) = std::pow(used.prod(), 1 / static_cast<double>(axes)) / used;
  }
  return scale;
}

}  // namespace

struct InsideBody::Tree {
  Eigen::Array3d scale;
  Points points;              ///< scaled
  std::vector<double> reach;  ///< of each point, mm
  PointTree tree;

  Tree(const Points& p, std::span<const double> volume, bool planar, const Eigen::Array3d& s)
      : scale(s), points(p.array().rowwise() * s.transpose()), tree(points) {
    // between Gauss points, two a side of a cube, it is at most 0.82 of their share's side in the plane, 1 in space
    for (const double v : volume) {
      reach.push_back(planar ? 0.9 * std::sqrt(v) : 1.05 * std::cbrt(v));
    }
  }
};

InsideBody::InsideBody(const Points& points, std::span<const double> volume, bool planar, const Eigen::Array3d& lengths)
    : tree_(std::make_shared<const Tree>(points, volume, planar, to_cubes(lengths, planar))) {}

bool InsideBody::operator()(const Eigen::Vector3d& x) const {
  return is_within(x, 0);
}

bool InsideBody::is_within(const Eigen::Vector3d& x, double distance) const {
  const Eigen::Vector3d scaled = x.array() * tree_->scale;
  const auto [nearest, squared] = tree_->tree.nearest(scaled.data());
  const double reach = tree_->reach[nearest] + distance * tree_->scale.maxCoeff();
  return squared <= reach * reach;
}

}  // namespace brainshift::solve
