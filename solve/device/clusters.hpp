// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/device/view.hpp"
#include "solve/force/point_blocks.hpp"

namespace brainshift::solve::device {

/// PointBlocks as a device reads them: pairs by point and, once more, by slot, so that forces are summed in one order
/// without atomics.
template <class Scalar>
struct Clusters {
  std::vector<Cluster> clusters;
  std::vector<PatchPoints> patches;
  std::vector<std::int32_t> patch_of;  ///< one a point
  std::vector<std::int64_t> pair_begin;
  std::vector<Pair<Scalar>> pairs;
  std::vector<std::int32_t> slot_node;
  std::vector<std::int64_t> slot_begin;
  std::vector<Pair<Scalar>> slot_pairs;
  std::vector<std::int64_t> node_begin;
  std::vector<std::int32_t> node_slot;
  std::vector<std::int64_t> touch_begin;  ///< one a slot
  std::vector<Touch> touches;
  std::vector<std::int64_t> patch_touch_begin;
  std::vector<std::int64_t> patch_touch;
  std::vector<std::int32_t> patch_touch_node;
  std::int32_t most_slots = 0, most_points = 0;
};

/// count: of the clusters, about as large as each other; fewer where there are fewer patches.
template <class Scalar>
Clusters<Scalar> make_clusters(const PointBlocks& points, std::int32_t count);

/// V, compressed rows.
struct CompressedRows {
  std::vector<std::int64_t> begin = {0};
  std::vector<std::int32_t> node;  ///< ascending in a row
  std::vector<double> shape;

  bool operator==(const CompressedRows&) const = default;
};

/// Vᵀ of those nodes that are in any row.
struct NodeRows {
  std::vector<std::int32_t> node;
  std::vector<std::int64_t> begin = {0};
  std::vector<std::int32_t> row;
  std::vector<double> shape;
};

NodeRows by_node(const CompressedRows& rows);

}  // namespace brainshift::solve::device
