// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "solve/arrays/nodal_vectors.hpp"
#include "solve/force/point_blocks.hpp"
#include "solve/force/point_laws.hpp"

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

/// Nodal values, four a slot, in the precision of the derivatives: one of the two is empty.
struct SlotVectors {
  std::vector<double> in_double;
  std::vector<float> in_single;

  SlotVectors(std::size_t slots, Precision precision)
      : in_double(precision == Precision::double_precision ? 4 * slots : 0),
        in_single(precision == Precision::single_precision ? 4 * slots : 0) {}

  template <class Scalar>
  std::vector<Scalar>& of() {
    if constexpr (std::is_same_v<Scalar, float>) {
      return in_single;
    } else {
      return in_double;
    }
  }
};

/// Room of one thread: for the nodes of a block and the points of a batch of its patches.
struct Batch {
  SlotVectors displacement;  ///< û less that of the block's first slot: single precision keeps its digits for strains
  std::vector<TensorLanes> gradient, stress;
  std::vector<double> jacobian, dilatation, pressure, volume;  ///< `lanes` a group

  Batch(std::size_t slots, std::size_t points, Precision precision);
};

/// Scratch of internal_force(), made once and reused in every step, and what points remember between steps.
struct ForceScratch {
  NodalVectors parameters;                      ///< those of the last internal_force()
  SlotVectors force;                            ///< of the blocks
  std::vector<Batch> batches;                   ///< one a thread
  std::vector<double> jacobian;                 ///< transient: J of each point, of the elastic part
  std::vector<JacobianRange> block_jacobian;    ///< one a block
  std::vector<double> thickness;                ///< plane stress: F_33 of each point, where the next search starts
  std::vector<double> growth = {};              ///< with swelling: stretch at rest, one a row of the laws; see swell()
  std::vector<std::size_t> viscous_begin = {};  ///< transient with Prony terms: offset of each point's state
  std::vector<double> viscous_state = {};

  ForceScratch(const PointBlocks& points, const PointLaws& laws);

  /// Lets the tissues swell by a fraction of what the laws say: the next internal_force() and all that reads the
  /// gradients of the last one see it.
  void swell(const PointLaws& laws, double fraction);

  /// Stretch at rest of a row of the laws: 1 without swelling.
  double growth_of(std::int32_t row) const { return growth.empty() ? 1 : growth[static_cast<std::size_t>(row)]; }

  /// Takes over what the points of another remember; from: the number there of each point here.
  void remember(const ForceScratch& other, std::span<const std::int32_t> from);
};

}  // namespace brainshift::solve
