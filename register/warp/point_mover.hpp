// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "register/field/field_sampler.hpp"
#include "segmentation/files/point_values.hpp"
#include "segmentation/geometry/points.hpp"

namespace brainshift::registration {

/// What happened to the points of a file.
struct MovedPoints {
  std::size_t points = 0;
  std::size_t outside = 0;  ///< of the field's image: they stay
  std::size_t removed = 0;  ///< in what a resection has taken out: where they go means nothing
  double largest = 0;       ///< displacement, mm
};

/// Moves points with a field, linear interpolation, and counts them. Zero displacement outside the image; a point on
/// the outermost half voxel is inside. The field must outlive it.
class PointMover {
 public:
  explicit PointMover(const VectorImage& field, ValuesOfPoints values = {},
                      std::function<bool(const Eigen::Vector3d&)> is_removed = {})
      : sampler_(field), values_(std::move(values)), is_removed_(std::move(is_removed)) {}

  /// mm, LPS.
  Eigen::Vector3d displacement(const Eigen::Vector3d& place) {
    const Eigen::Vector3d index = sampler_.to_index(place);
    ++moved_.points;
    if (!sampler_.inside(index)) {
      ++moved_.outside;
      return Eigen::Vector3d::Zero();
    }
    moved_.removed += is_removed_ && is_removed_(place) ? 1 : 0;
    const Eigen::Vector3d u = sampler_.value(index);
    moved_.largest = std::max(moved_.largest, u.norm());
    return u;
  }

  /// What goes along with points, at their places before they move: how far the displacement may be off; NaN where that
  /// is not known.
  std::vector<PointValues> values(const Points& places) const {
    return values_ ? values_(places) : std::vector<PointValues>{};
  }

  /// The same for formats of whose readers some know no NaN: 0 there.
  std::vector<PointValues> finite_values(const Points& places) const {
    std::vector<PointValues> all = values(places);
    for (PointValues& each : all) {
      std::ranges::replace_if(
          each.values, [](double value) { return std::isnan(value); }, 0.0);
    }
    return all;
  }

  const MovedPoints& moved() const { return moved_; }

 private:
  FieldSampler sampler_;
  ValuesOfPoints values_;
  std::function<bool(const Eigen::Vector3d&)> is_removed_;
  MovedPoints moved_;
};

/// Many of them, (n × 3).
Points move_points(PointMover& mover, const Points& points);

}  // namespace brainshift::registration
