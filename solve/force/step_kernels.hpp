// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "solve/arrays/lanes.hpp"

namespace brainshift::solve {

// The loops that take the time of a step, compiled for several levels of the x86-64 instruction set. Plain pointers:
// they run millions of times, and nothing that other files share may be compiled for a processor that is not there.

/// Rows of shape functions are padded with zeros to whole quads of pairs, so that rows of nearly the same length take
/// the same number of turns, which processors foresee.
inline constexpr std::size_t quad = 4;

/// A tensor of 3 × 3, column-major, at each of `lanes` points.
struct alignas(64) TensorLanes {
  double entry[9][lanes];
};

/// The shape functions of points, as PointBlocks has them.
template <class Scalar>
struct PairRows {
  const std::int64_t* begin;  ///< one a point, and the end; in pairs
  const std::uint16_t* slot;  ///< one a pair
  const Scalar* derivative;   ///< 3 a pair, 1/mm
};

/// For nodal values kept as Scalar, four a slot of which the last is not used.
template <class Scalar>
struct PairKernels {
  /// F = 1 + Σ_a û_a ⊗ B_a at points [first, last) from displacement, mm. The lanes after the last are 1.
  void (*gradients)(const PairRows<Scalar>& rows, std::int32_t first, std::int32_t last, const Scalar* displacement,
                    TensorLanes* gradient);
  /// f_a += S · B_a, S (stress times volume, µN mm) of points [first, last).
  void (*spread)(const PairRows<Scalar>& rows, std::int32_t first, std::int32_t last, const TensorLanes* stress,
                 Scalar* force);
};

struct StepKernels {
  const char* name;  ///< of the instruction set
  PairKernels<double> in_double;
  PairKernels<float> in_single;
  /// J = det F, `lanes` a group.
  void (*jacobian)(const TensorLanes* gradient, std::size_t groups, double* jacobian);
  /// volume (P_iso + p ∂J/∂F) of neo-Hookean points: NeoHookean::isochoric_stress, µN mm. pressure p, Pa, and volume,
  /// mm³: `lanes` a group. NaN where J is not positive.
  void (*neo_hookean)(const TensorLanes* gradient, std::size_t groups, double shear_modulus, const double* pressure,
                      const double* volume, TensorLanes* stress);

  template <class Scalar>
  const PairKernels<Scalar>& of() const {
    if constexpr (sizeof(Scalar) == sizeof(float)) {
      return in_single;
    } else {
      return in_double;
    }
  }
};

/// Those that this processor runs, the fastest first.
std::span<const StepKernels> step_kernels();

}  // namespace brainshift::solve
