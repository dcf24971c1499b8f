// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "discretise/node_cloud.hpp"

namespace brainshift::solve {

/// The cloud with its nodes along a space-filling curve, and where each came from.
struct OrderedCloud : NodeCloud {
  std::vector<std::int32_t> original;  ///< the cloud's node
};

/// Rows of the cloud; prescribed_displacement is NaN where it has none.
NodeCloud subset(const NodeCloud& cloud, const std::vector<std::int32_t>& nodes);

/// All of its rows.
OrderedCloud order_nodes(const NodeCloud& cloud);

std::vector<std::int32_t> surface_nodes(const OrderedCloud& cloud);

/// Surface nodes that nothing prescribes.
std::vector<std::int32_t> free_surface_nodes(const OrderedCloud& cloud);

/// Nodes with a prescribed displacement or a force.
std::size_t count_loaded(const OrderedCloud& cloud);

/// Bytes that a cloud takes.
std::size_t cloud_bytes(const NodeCloud& cloud);

/// Rows of ordered nodes in the cloud's own order.
Points in_original_order(const Points& values, const std::vector<std::int32_t>& original);

}  // namespace brainshift::solve
