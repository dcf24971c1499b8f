// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/dynamics/point_blocks.hpp"
#include "solve/dynamics/point_laws.hpp"

namespace brainshift::solve {

/// Points worked on at once, and more up to whole patches: their derivatives stay in the cache between the two passes.
inline constexpr std::int32_t batch_points = 32;

inline std::size_t groups_of(std::size_t points) {
  return (points + lanes - 1) / lanes;
}

/// What has become of J at the points; NaN where one is.
struct JacobianRange {
  double smallest = 1;
  double least_ratio = 1;  ///< of J to that of the internal_force() before; 1 where it is not followed
};

/// Nodal values of the blocks, four a slot, in the precision of the derivatives.
template <class Scalar>
struct SlotVectors {
  /// û less that of the block's first slot: single precision keeps its digits for what strains.
  std::vector<Scalar> displacement;
  std::vector<Scalar> force;

  std::size_t held_bytes() const { return bytes(displacement) + bytes(force); }
};

/// Room for the points of a batch of patches, of one thread.
struct Batch {
  std::vector<TensorLanes> gradient, stress;
  std::vector<double> jacobian, dilatation, pressure, volume;  ///< `lanes` a group

  explicit Batch(std::size_t points);
  std::size_t held_bytes() const {
    return bytes(gradient) + bytes(stress) + bytes(jacobian) + bytes(dilatation) + bytes(pressure) + bytes(volume);
  }
};

/// Scratch of internal_force(), made once and reused in every step, and what points remember between steps.
struct ForceScratch {
  SlotVectors<double> in_double;                ///< empty in single precision
  SlotVectors<float> in_single;                 ///< empty in double precision
  std::vector<Batch> batches;                   ///< one a thread
  std::vector<double> jacobian;                 ///< transient: J of each point
  std::vector<JacobianRange> block_jacobian;    ///< one a block
  std::vector<double> thickness;                ///< plane stress: F_33 of each point, where the next search starts
  std::vector<std::size_t> viscous_begin = {};  ///< transient with Prony terms: offset of each point's state
  std::vector<double> viscous_state = {};

  ForceScratch(const PointBlocks& points, const PointLaws& laws);

  /// Takes over what the points of another remember; from: the number there of each point here.
  void remember(const ForceScratch& other, std::span<const std::int32_t> from);

  std::size_t viscous_bytes() const { return bytes(viscous_begin) + bytes(viscous_state); }
  /// All but what relaxing materials remember.
  std::size_t scratch_bytes() const;
};

}  // namespace brainshift::solve
