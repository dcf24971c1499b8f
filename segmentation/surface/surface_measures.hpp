// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "segmentation/geometry/surface.hpp"

namespace brainshift::segmentation {

/// A surface that has to swell by more than this share to hold its volume has lost its thin parts.
inline constexpr double most_lost_before = 0.05;

/// How good a surface is.
struct SurfaceMeasures {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  double volume = 0;                ///< mm³
  double label_volume = 0;          ///< of the voxels it encloses, mm³
  double lost_before = 0;           ///< share of label_volume that it was off before its volume was fitted
  double boundary_distance_95 = 0;  ///< 95th percentile over the surface of the distance to the label boundary, mm
  double edge_length_mean = 0;      ///< mm
  double edge_length_target = 0;    ///< mm; shorter than the one asked for where that was too coarse for the label
  bool closed = false;              ///< every edge between two triangles, 2-manifold
  bool outward = false;             ///< the triangles face outward
  bool self_intersecting = true;
  bool repaired = false;  ///< made with the rescue (alpha wrap)
  /// Of a mask: volume within 1 %, boundary_distance_95 within 1 mm, lost_before within most_lost_before.
  bool within_bounds = false;

  /// Fit for the other stages.
  bool is_sound() const { return closed && outward && !self_intersecting; }
};

/// What can be said of a surface alone: all but label_volume, lost_before, boundary_distance_95, edge_length_target,
/// repaired and within_bounds.
SurfaceMeasures measure(const Surface& surface);

/// Mean length of the triangles' edges, mm.
double mean_edge_length(const Surface& surface);

}  // namespace brainshift::segmentation
