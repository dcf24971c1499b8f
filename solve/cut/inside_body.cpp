// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/inside_body.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "segmentation/geometry/point_tree.hpp"

namespace brainshift::solve {

struct InsideBody::Tree {
  Points points;
  std::vector<double> reach;  ///< of each point, mm
  PointTree tree;

  Tree(Points p, std::span<const double> volume, bool planar) : points(std::move(p)), tree(points) {
    // between Gauss points, two a side of a cell, it is at most 0.82 of their share's side in the plane, 1 in space
    for (const double v : volume) {
      reach.push_back(planar ? 0.9 * std::sqrt(v) : 1.05 * std::cbrt(v));
    }
  }
};

InsideBody::InsideBody(Points points, std::span<const double> volume, bool planar)
    : tree_(std::make_shared<const Tree>(std::move(points), volume, planar)) {}

bool InsideBody::operator()(const Eigen::Vector3d& x) const {
  const auto [nearest, squared] = tree_->tree.nearest(x.data());
  return squared <= tree_->reach[nearest] * tree_->reach[nearest];
}

}  // namespace brainshift::solve
