// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace brainshift::solve {

// What every law shares: the volumetric energy U(θ) = K/2 θ² of its dilatation θ, at a point or averaged over a patch.

/// p = U'(θ) = K θ, Pa.
template <class OneLaw>
double volumetric_pressure(const OneLaw& law, double dilatation) {
  return law.bulk_modulus * dilatation;
}

/// U(θ), Pa.
template <class OneLaw>
double volumetric_energy(const OneLaw& law, double dilatation) {
  return law.bulk_modulus / 2 * dilatation * dilatation;
}

/// λ + 2µ = K + 4µ/3 of small strains, Pa: ρ c_d², c_d the speed of dilatational waves.
template <class OneLaw>
double wave_modulus(const OneLaw& law) {
  return law.bulk_modulus + 4 * law.shear_modulus / 3;
}

}  // namespace brainshift::solve
