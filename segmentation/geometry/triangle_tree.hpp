// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "segmentation/geometry/surface.hpp"

namespace brainshift {

/// A search tree on triangles (CGAL's AABB tree, exact predicates). Cheap to copy; const calls may run on many threads.
class TriangleTree {
 public:
  /// At least one triangle, none without an area.
  explicit TriangleTree(const std::vector<Triangle>& triangles);

  /// The triangle nearest to a place, mm.
  std::size_t nearest(const Eigen::Vector3d& x) const;

  /// Squared distance of a place to the nearest triangle, mm².
  double squared_distance(const Eigen::Vector3d& x) const;

  /// Replaces found by the triangles that the segment from one place to another, different one meets.
  void find_crossed(const Eigen::Vector3d& from, const Eigen::Vector3d& to, std::vector<std::size_t>& found) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace brainshift
