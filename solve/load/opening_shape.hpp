// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/load/best_fit_plane.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/load/extension.hpp"

namespace brainshift::solve {

/// Half the median distance from a point to its nearest neighbour, mm, 5 at most; absent for points in one place.
std::optional<double> default_margin(const Points& measured);

/// Where a load acts: in the best-fit plane of its points, their convex hull widened by a margin (mm).
class OpeningShape {
 public:
  /// surface: places on it, which tell the plane where the points lie along a line.
  OpeningShape(const CraniotomyLoad& load, const Points& surface, double margin);

  /// Places in the axes of the plane: along it, along it, above it.
  Points local(const Points& places) const { return plane_.local(places); }
  /// How far a local place lies beyond the rim in the plane, mm; inside the hull minus the margin.
  double beyond_rim(const Eigen::RowVector3d& place) const;
  /// What is measured, extended to a local place, no farther than to the rim: the place nearest to it there then
  /// counts. Absent where it lies farther than `past` (mm) beyond the rim, or than `depth` above or below.
  std::optional<Eigen::RowVector3d> displacement_at(const Eigen::RowVector3d& place, double past, double depth) const;

 private:
  Plane3 plane_;
  double margin_;
  PlanePoints points_;
  Values known_;  // height and displacement of each point
  double lowest_, highest_;
  std::vector<Eigen::Vector2d> hull_;
};

}  // namespace brainshift::solve
