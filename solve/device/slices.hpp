// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/device/clusters.hpp"

namespace brainshift::solve::device {

/// The pairs of clusters by point, so laid out that threads next to each other read what lies next to each other: a
/// slice has eight points of nearly equal supports, and at each of its turns four pairs of every point. Where a point
/// has no pair left there is one without a derivative.
template <class Scalar>
struct Slices {
  std::vector<std::int32_t> cluster_begin = {0};  ///< first slice of each cluster
  std::vector<std::int64_t> turn_begin = {0};     ///< first turn of each slice
  std::vector<std::int32_t> point;                ///< of the cluster, slice_points a slice; -1: none
  std::vector<Pair<Scalar>> pairs;                ///< slice_points * slice_lanes a turn
  std::vector<double> reach;                      ///< of each cluster: the largest Σ |∂φ/∂X|₁ of a slot, 1/mm
};

template <class Scalar>
Slices<Scalar> make_slices(const Clusters<Scalar>& clusters);

}  // namespace brainshift::solve::device
