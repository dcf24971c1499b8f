// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include "segmentation/geometry/points.hpp"

namespace brainshift::solve {

/// Whether a place lies inside the body, as its integration points tell: one is as near as such points are apart. Where
/// cells are longer one way than another, distances are counted in their lengths.
class InsideBody {
 public:
  /// Integration points (n × 3) mm and their volumes, mm³; planar ones count as 1 mm thick. lengths: of the cells along
  /// the axes, mm, which only their ratios count of.
  InsideBody(const Points& points, std::span<const double> volume, bool planar,
             const Eigen::Array3d& lengths = Eigen::Array3d::Ones());
  bool operator()(const Eigen::Vector3d& x) const;
  /// Whether part of the body may lie within a distance, mm, of x.
  bool is_within(const Eigen::Vector3d& x, double distance) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace brainshift::solve
