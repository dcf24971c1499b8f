// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "discretise/interface/node_cloud.hpp"
#include "solve/interface/conditions.hpp"

namespace brainshift::solve {

/// The cloud with its nodes along a space-filling curve, what is prescribed there, and where each came from.
struct OrderedCloud : NodeCloud {
  Conditions conditions;               ///< displacement has a row a node
  std::vector<std::int32_t> original;  ///< the cloud's node
};

/// Rows of the cloud.
NodeCloud subset(const NodeCloud& cloud, const std::vector<std::int32_t>& nodes);

/// All of its rows.
OrderedCloud order_nodes(const NodeCloud& cloud, const Conditions& conditions);

/// Surface nodes that nothing prescribes.
std::vector<std::int32_t> free_surface_nodes(const NodeCloud& cloud, const Conditions& conditions);

/// Whether more of the surface is prescribed than free: that is no opening, and a skull about it hardly holds the body.
bool mostly_prescribed(const NodeCloud& cloud, const Conditions& conditions);

/// Rows of ordered nodes in the cloud's own order.
Points in_original_order(const Points& values, const std::vector<std::int32_t>& original);
std::vector<double> in_original_order(const std::vector<double>& values, const std::vector<std::int32_t>& original);

}  // namespace brainshift::solve
