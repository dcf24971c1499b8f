// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "segmentation/geometry/surface.hpp"

namespace brainshift::discretise {

/// Where lines along x pass through a closed surface: the inside test of this stage. Triangles are found by buckets in
/// the y-z plane; an edge or a vertex that a line meets exactly belongs to one side consistently, so that the parity
/// holds for any line. By hand because CGAL's Side_of_triangle_mesh answers for one point, not for all of a line. Const
/// calls may run on many threads.
class Scanlines {
 public:
  /// A closed surface, mm.
  explicit Scanlines(const Surface& surface);

  /// The part of a body that lies within another one, or outside it.
  Scanlines(const Scanlines& body, std::shared_ptr<const Scanlines> other, bool within);

  /// The x at which the line (·, y, z) enters and leaves the body, ascending: pairs of them enclose the inside.
  void crossings(double y, double z, std::vector<double>& x) const;

  /// Strictly between an entry and an exit of the line through it.
  bool inside(const Eigen::Vector3d& point) const;

 private:
  void collect(double y, double z, std::vector<double>& x) const;
  void own_crossings(double y, double z, std::vector<double>& x) const;
  std::size_t bucket(Eigen::Index iy, Eigen::Index iz) const { return static_cast<std::size_t>(iz * buckets_y_ + iy); }

  Surface surface_;
  Eigen::Vector2d low_;
  Eigen::Vector2d high_;
  double bucket_edge_ = 1;
  Eigen::Index buckets_y_ = 1;
  Eigen::Index buckets_z_ = 1;
  std::vector<std::size_t> begin_;  ///< (buckets + 1) offsets into triangle_
  std::vector<std::int32_t> triangle_;
  std::shared_ptr<const Scanlines> other_;  ///< that it lies within, or outside; null: the whole body
  bool within_ = false;
};

}  // namespace brainshift::discretise
