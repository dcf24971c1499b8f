// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "solve/force/step_kernels.hpp"
#include "solve/interface/options.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/quadrature/pressure_patches.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

/// Integration points whose dilatation is projected onto the patch's pressure modes; without projection, one point.
struct Patch {
  std::int32_t first_point, last_point;  ///< [first, last)
  std::int32_t material;                 ///< row of the material table
  std::int64_t first_slot = 0;           ///< of its block
};

/// About a thousand consecutive points, handled by one thread at a time with its nodes gathered side by side. The
/// division into blocks does not depend on the number of threads, and the blocks' forces are added in their order: so
/// results are the same bit for bit.
struct Block {
  std::int32_t first_patch, last_patch;  ///< [first, last)
  std::int64_t first_slot;               ///< of its local nodes in slot_node
  std::int32_t slots;                    ///< local nodes
};

/// What stepping reads, in the order in which it reads it: prepared once, never changed.
struct PointBlocks {
  std::vector<Block> blocks;
  std::vector<Patch> patches;
  std::vector<double> volume;            ///< one a point, mm³
  std::vector<double> mode;              ///< (points × 4) pressure modes, orthonormal in Σ w over a patch; empty
                                         ///< where each point is a patch of its own
  std::vector<std::int64_t> pair_begin;  ///< (points + 1); rows are padded to whole quads, see step_kernels.hpp
  std::vector<std::uint16_t> support;    ///< one a point: nodes, without the padding
  std::vector<std::uint16_t> pair_slot;  ///< one a (point, node) pair: local node of the block
  std::vector<double> pair_derivative;   ///< (pairs × 3) ∂φ_a/∂X_J, 1/mm; empty in single precision
  std::vector<float> pair_single;        ///< the same in single precision; empty in double
  std::vector<std::int32_t> slot_node;   ///< one a slot: node
  std::vector<std::int64_t> node_begin;  ///< (nodes + 1) offsets into node_slot
  std::vector<std::int32_t> node_slot;   ///< the slots of a node, in block order
  std::vector<double> felt;              ///< felt_tissues() of a body that comes to rest; empty in time

  std::size_t points() const { return volume.size(); }
  std::size_t nodes() const { return node_begin.size() - 1; }
  std::size_t slots() const { return slot_node.size(); }
  std::span<const std::uint16_t> slots_of(std::int32_t point) const {
    return std::span(pair_slot).subspan(static_cast<std::size_t>(pair_begin[static_cast<std::size_t>(point)]),
                                        support_size(point));
  }
  std::int32_t node_of(const Block& block, std::uint16_t slot) const {
    return slot_node[static_cast<std::size_t>(block.first_slot) + slot];
  }
  std::size_t support_size(std::int32_t point) const { return support[static_cast<std::size_t>(point)]; }
  Eigen::Vector4d modes_of(std::int32_t point) const {
    const auto p = static_cast<std::size_t>(point);
    if (mode.empty()) {
      return {1 / std::sqrt(volume[p]), 0, 0, 0};
    }
    return Eigen::Map<const Eigen::Vector4d>(mode.data() + 4 * p);
  }
  Precision precision() const {
    return pair_single.empty() ? Precision::double_precision : Precision::single_precision;
  }
  /// (support × 3) derivatives of a point's shape functions; Scalar is that of precision().
  template <class Scalar>
  const Scalar* derivatives_of(std::int32_t point) const {
    const std::int64_t offset = 3 * pair_begin[static_cast<std::size_t>(point)];
    if constexpr (std::is_same_v<Scalar, float>) {
      return pair_single.data() + offset;
    } else {
      return pair_derivative.data() + offset;
    }
  }
  template <class Scalar>
  PairRows<Scalar> rows() const {
    return {pair_begin.data(), pair_slot.data(), derivatives_of<Scalar>(0)};
  }
};

/// Lays out points and their shape functions, in the order of the patches. material: row of the material table, one a
/// point.
PointBlocks point_blocks(const IntegrationPoints& points, const ShapeRows& rows, std::span<const std::int32_t> material,
                         std::size_t nodes, const PressurePatches& patches,
                         Precision precision = Precision::double_precision);

}  // namespace brainshift::solve
