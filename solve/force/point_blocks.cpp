// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/point_blocks.hpp"

#include <algorithm>
#include <numeric>
#include <type_traits>

namespace brainshift::solve {

namespace {

constexpr std::int64_t pairs_per_block =
    65535;  // so that a block's nodes are numbered in 16 bits, whatever the supports

constexpr std::int32_t points_per_block =
    1024;  // a block's nodes, forces and derivatives stay in the second-level cache

std::int64_t pairs_of(const Patch& patch, const ShapeRows& rows, const std::vector<std::int32_t>& order) {
  std::int64_t pairs = 0;
  for (std::int32_t k = patch.first_point; k < patch.last_point; ++k) {
    const auto p = static_cast<std::size_t>(order[static_cast<std::size_t>(k)]);
    pairs += static_cast<std::int64_t>(rows[p].size());
  }
  return pairs;
}

/// Copies the shape functions of a point, with zeros up to a whole quad.
void append_row(PointBlocks& out, const ShapeRows& rows, std::size_t point, Precision precision,
                const std::vector<std::int32_t>& slot_of_node) {
  const ShapeRow row = rows[point];
  const std::size_t size = row.size(), padded = (size + quad - 1) / quad * quad;
  for (std::size_t pair = 0; pair < padded; ++pair) {
    const auto node = static_cast<std::size_t>(row.node[pair < size ? pair : 0]);
    out.pair_slot.push_back(static_cast<std::uint16_t>(slot_of_node[node]));
  }
  const auto copy = [&](auto& derivative) {
    using Scalar = typename std::remove_reference_t<decltype(derivative)>::value_type;
    for (const double component : row.derivative) {
      derivative.push_back(static_cast<Scalar>(component));
    }
    derivative.resize(derivative.size() + 3 * (padded - size));
  };
  precision == Precision::single_precision ? copy(out.pair_single) : copy(out.pair_derivative);
  out.support.push_back(static_cast<std::uint16_t>(size));
  out.pair_begin.push_back(static_cast<std::int64_t>(out.pair_slot.size()));
}

/// Copies the shape functions of a block's points, with its nodes numbered 0, 1, ... in the order of the nodes.
void append_block(PointBlocks& out, const ShapeRows& rows, const std::vector<std::int32_t>& order, Block block,
                  Precision precision, std::vector<std::int32_t>& slot_of_node) {
  const std::int32_t first = out.patches[static_cast<std::size_t>(block.first_patch)].first_point;
  const std::int32_t last = out.patches[static_cast<std::size_t>(block.last_patch - 1)].last_point;
  std::vector<std::int32_t> nodes;
  for (std::int32_t k = first; k < last; ++k) {
    const auto p = static_cast<std::size_t>(order[static_cast<std::size_t>(k)]);
    const std::span<const std::int32_t> support = rows[p].node;
    nodes.insert(nodes.end(), support.begin(), support.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    slot_of_node[static_cast<std::size_t>(nodes[s])] = static_cast<std::int32_t>(s);
  }
  block.first_slot = static_cast<std::int64_t>(out.slot_node.size());
  block.slots = static_cast<std::int32_t>(nodes.size());
  out.slot_node.insert(out.slot_node.end(), nodes.begin(), nodes.end());
  for (std::int32_t k = first; k < last; ++k) {
    append_row(out, rows, static_cast<std::size_t>(order[static_cast<std::size_t>(k)]), precision, slot_of_node);
  }
  for (std::int32_t i = block.first_patch; i < block.last_patch; ++i) {
    out.patches[static_cast<std::size_t>(i)].first_slot = block.first_slot;
  }
  out.blocks.push_back(block);
}

void list_slots_of_nodes(PointBlocks& out, std::size_t nodes) {
  out.node_begin.assign(nodes + 1, 0);
  for (const std::int32_t node : out.slot_node) {
    ++out.node_begin[static_cast<std::size_t>(node) + 1];
  }
  std::partial_sum(out.node_begin.begin(), out.node_begin.end(), out.node_begin.begin());
  std::vector<std::int64_t> next(out.node_begin.begin(), out.node_begin.end() - 1);
  out.node_slot.resize(out.slot_node.size());
  for (std::size_t slot = 0; slot < out.slot_node.size(); ++slot) {
    std::int64_t& at = next[static_cast<std::size_t>(out.slot_node[slot])];
    out.node_slot[static_cast<std::size_t>(at++)] = static_cast<std::int32_t>(slot);
  }
}

void list_patches(const IntegrationPoints& points, std::span<const std::int32_t> material,
                  const PressurePatches& patched, PointBlocks& out) {
  const std::vector<std::int32_t>& order = patched.order;
  out.volume.reserve(order.size());
  out.patches.reserve(patched.size());
  for (const std::int32_t p : order) {
    out.volume.push_back(points.volume[static_cast<std::size_t>(p)]);
  }
  const bool shared_pressure = patched.size() < order.size();
  out.mode.resize(shared_pressure ? 4 * order.size() : 0);
  for (std::size_t i = 0; i < patched.size(); ++i) {
    const auto first = static_cast<std::size_t>(patched.begin[i]);
    const auto count = static_cast<std::size_t>(patched.begin[i + 1]) - first;
    out.patches.push_back(
        {patched.begin[i], patched.begin[i + 1], material[static_cast<std::size_t>(order[first])], 0});
    if (shared_pressure) {
      pressure_modes(points.positions, points.volume, std::span(order).subspan(first, count),
                     std::span(out.mode).subspan(4 * first, 4 * count));
    }
  }
}

void divide_into_blocks(const ShapeRows& rows, const std::vector<std::int32_t>& order, std::size_t nodes,
                        Precision precision, PointBlocks& out) {
  const std::size_t most_pairs = rows.node.size() + (quad - 1) * order.size();
  out.pair_slot.reserve(most_pairs);
  const bool single = precision == Precision::single_precision;
  single ? out.pair_single.reserve(3 * most_pairs) : out.pair_derivative.reserve(3 * most_pairs);
  out.support.reserve(order.size());
  out.pair_begin.reserve(order.size() + 1);
  out.pair_begin.push_back(0);
  std::vector<std::int32_t> slot_of_node(nodes, 0);
  Block block{0, 0, 0, 0};
  const auto patches = static_cast<std::int32_t>(out.patches.size());
  std::int64_t pairs = 0;
  for (std::int32_t i = 0; i < patches; ++i) {
    const Patch& patch = out.patches[static_cast<std::size_t>(i)];
    const std::int64_t more = pairs_of(patch, rows, order);
    const std::int32_t first_point = out.patches[static_cast<std::size_t>(block.first_patch)].first_point;
    const bool full = patch.last_point - first_point > points_per_block || pairs + more > pairs_per_block;
    if (full && block.last_patch > block.first_patch) {
      append_block(out, rows, order, block, precision, slot_of_node);
      block.first_patch = i;
      pairs = 0;
    }
    block.last_patch = i + 1;
    pairs += more;
  }
  append_block(out, rows, order, block, precision, slot_of_node);
}

}  // namespace

PointBlocks point_blocks(const IntegrationPoints& points, const ShapeRows& rows, std::span<const std::int32_t> material,
                         std::size_t nodes, const PressurePatches& patches, Precision precision) {
  PointBlocks out;
  list_patches(points, material, patches, out);
  divide_into_blocks(rows, patches.order, nodes, precision, out);
  list_slots_of_nodes(out, nodes);
  return out;
}

}  // namespace brainshift::solve
