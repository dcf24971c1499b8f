// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "register/field/field_sampler.hpp"
#include "segmentation/geometry/points.hpp"

namespace brainshift::registration {

/// What happened to the points of a file.
struct MovedPoints {
  std::size_t points = 0;
  std::size_t outside = 0;  ///< of the field's image: they stay
  double largest = 0;       ///< displacement, mm
};

/// The estimated error of the displacement, mm, at places (n × 3, mm, LPS) before they move; none: it is not known.
using ErrorOfPoints = std::function<std::optional<std::vector<double>>(const Points& places)>;

/// Moves points with a field, linear interpolation, and counts them. Zero displacement outside the image; a point on
/// the outermost half voxel is inside. The field must outlive it.
class PointMover {
 public:
  explicit PointMover(const VectorImage& field, ErrorOfPoints error = {}) : sampler_(field), error_(std::move(error)) {}

  /// mm, LPS.
  Eigen::Vector3d displacement(const Eigen::Vector3d& place) {
    const Eigen::Vector3d index = sampler_.to_index(place);
    ++moved_.points;
    if (!sampler_.inside(index)) {
      ++moved_.outside;
      return Eigen::Vector3d::Zero();
    }
    const Eigen::Vector3d u = sampler_.value(index);
    moved_.largest = std::max(moved_.largest, u.norm());
    return u;
  }

  std::optional<std::vector<double>> error(const Points& places) const {
    return error_ ? error_(places) : std::nullopt;
  }

  const MovedPoints& moved() const { return moved_; }

 private:
  FieldSampler sampler_;
  ErrorOfPoints error_;
  MovedPoints moved_;
};

/// Many of them, (n × 3).
Points move_points(PointMover& mover, const Points& points);

}  // namespace brainshift::registration
