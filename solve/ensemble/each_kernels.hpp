// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "solve/ensemble/each.hpp"
#include "solve/force/step_kernels.hpp"

namespace brainshift::solve {

// The loops that take the time of a step of all members, compiled for several levels of the x86-64 instruction set as
// step_kernels() are. A pair of a point and a node is one load of its derivative for all members, and no gathers.

/// For nodal values kept as Scalar.
template <class Scalar>
struct EachPairKernels {
  /// H = Σ_a û_a ⊗ B_a, F less 1, at points [first, last) from displacement, mm.
  void (*gradients)(const PairRows<Scalar>& rows, std::int32_t first, std::int32_t last,
                    const VectorOfEach<Scalar>* displacement, TensorOfEach<Scalar>* gradient);
  /// f_a += S · B_a, S (stress times volume, µN mm) of points [first, last).
  void (*spread)(const PairRows<Scalar>& rows, std::int32_t first, std::int32_t last,
                 const TensorOfEach<Scalar>* stress, VectorOfEach<Scalar>* force);
  /// θ = det F − 1 from H; smallest: the lesser of what it was and of these, NaN where one is.
  void (*dilatation)(const TensorOfEach<Scalar>* gradient, std::size_t points, NumberOfEach<double>* dilatation,
                     NumberOfEach<double>& smallest);
  /// From H to volume (P_iso + p ∂J/∂F) of neo-Hookean points, in its place: NeoHookean::isochoric_stress, µN mm.
  /// pressure, Pa; volume, mm³, one a point.
  void (*neo_hookean)(TensorOfEach<Scalar>* tensor, std::size_t points, const NumberOfEach<double>& shear_modulus,
                      const NumberOfEach<double>* pressure, const double* volume);
};

/// The moduli by which points of one material resist their dilatation, Pa: point_pressure().
struct DilatationModuli {
  NumberOfEach<double> seen;    ///< K, of what the patch's pressure modes see
  NumberOfEach<double> unseen;  ///< k, of the rest
};

struct EachKernels {
  const char* name;  ///< of the instruction set
  EachPairKernels<double> in_double;
  EachPairKernels<float> in_single;
  /// point_pressure() but for its barrier, at the points of one patch. mode: 4 a point; null: the points share nothing.
  void (*pressure)(const double* mode, const double* volume, std::size_t points, const DilatationModuli& moduli,
                   const NumberOfEach<double>* dilatation, NumberOfEach<double>* pressure);

  template <class Scalar>
  const EachPairKernels<Scalar>& of() const {
    if constexpr (sizeof(Scalar) == sizeof(float)) {
      return in_single;
    } else {
      return in_double;
    }
  }
};

/// Those that this processor runs, the fastest first, as many as there are step_kernels().
std::span<const EachKernels> each_kernels();

}  // namespace brainshift::solve
