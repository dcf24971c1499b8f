// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Bridge to nanoflann, for .cpp files: not a public header. Its distances are squared.

#include <cstddef>
#include <nanoflann.hpp>

#include "segmentation/geometry/points.hpp"

namespace brainshift {

/// Lets nanoflann read rows of Points in place.
struct PointRows {
  const Points* points;

  std::size_t kdtree_get_point_count() const { return static_cast<std::size_t>(points->rows()); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return (*points)(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(axis));
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// A k-d tree on points that outlive it. Const calls may run on many threads.
class PointTree {
 public:
  explicit PointTree(const Points& points)
      : rows_{&points}, tree_(3, rows_, nanoflann::KDTreeSingleIndexAdaptorParams(12)) {}
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  /// Row of the nearest point and the squared distance to it.
  std::pair<std::size_t, double> nearest(const double* x) const {
    std::size_t index = 0;
    double squared = 0;
    tree_.knnSearch(x, 1, &index, &squared);
    return {index, squared};
  }

  /// The nearest `count`, nearest first; returns how many there were.
  std::size_t nearest(const double* x, std::size_t count, std::size_t* index, double* squared) const {
    return tree_.knnSearch(x, count, index, squared);
  }

 private:
  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointRows>, PointRows, 3, std::size_t>;
  PointRows rows_;
  Tree tree_;
};

}  // namespace brainshift
