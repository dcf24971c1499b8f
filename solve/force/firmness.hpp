// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/force/point_blocks.hpp"

namespace brainshift::solve {

/// Σ w |B_a|² over a node's points of each tissue, (nodes × tissues), mm; tissues: rows of the material table. Empty
/// where all tissue is one.
std::vector<double> felt_tissues(const PointBlocks& points, std::size_t tissues);

/// g_a = √µ of the tissue that a node feels, µ its mean by PointBlocks::felt, Pa^½; empty where that is.
/// shear_modulus: one a tissue.
std::vector<double> node_firmness(const PointBlocks& points, std::span<const double> shear_modulus);

/// The shares h_a of nodes in a bound, as stiffness_bound() has it: max(g_a/g, σ), with g the firmest of them and
///   σ = Σ_b r_b (1 − g_b/g) / Σ_b r_b.
/// Soft nodes whose supports hardly reach into stiff tissue so get little of its mass, with which they would crawl.
/// Σ_b r_b/h_b ≤ 2 Σ_b r_b: others hardly get more than twice theirs, of a point's at most four times, as the norm
/// there is no larger than its trace.
class NodeShares {
 public:
  /// All must outlive it. firmness: node_firmness(); without it all shares are 1.
  NodeShares(const PointBlocks& points, const Block& block, std::span<const double> firmness)
      : points_(points), block_(block), firmness_(firmness) {}

  /// Of the nodes in these slots of the block; reach: their r_b ≥ 0. Valid until the next call.
  std::span<const double> of(std::span<const std::uint16_t> slots, std::span<const double> reach);

 private:
  const PointBlocks& points_;
  const Block& block_;
  std::span<const double> firmness_;
  std::vector<double> share_;
};

}  // namespace brainshift::solve
