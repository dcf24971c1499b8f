// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "solve/material/deformation.hpp"
#include "solve/material/linear_elastic.hpp"
#include "solve/material/material.hpp"

namespace brainshift::solve {

// Relaxation of the isochoric stress, for runs in real time. With S0 the isochoric second Piola-Kirchhoff stress of the
// elastic law, S = (1 − Σ g_i) S0 + Σ g_i h_i, where h_i follows S0 and forgets with its time: dh_i/dt + h_i/τ_i =
// dS0/dt (Simo 1987, Comput. Methods Appl. Mech. Engrg. 60:153). A step is exact where S0 goes along a straight line,
//   h_i ← e^(−Δt/τ_i) h_i + (1 − e^(−Δt/τ_i))/(Δt/τ_i) ΔS0,
// so second-order accurate and stable for every Δt; a Δt far above τ_i gives the relaxed stress, as it should.

/// The factors of one Δt, computed once.
struct PronyStep {
  struct Term {
    double share;  ///< g_i
    double decay;  ///< e^(−Δt/τ_i) − 1, from expm1: added to h_i it keeps the digits that e^(−Δt/τ_i) next to 1 drops
    double response;  ///< (1 − e^(−Δt/τ_i))/(Δt/τ_i)
  };
  double lasting;  ///< 1 − Σ g_i
  std::vector<Term> terms;

  /// Δt > 0 in s.
  PronyStep(std::span<const PronyTerm> prony, double time_step);
};

/// Doubles of state per integration point: S0 and each h_i as (11, 22, 33, 12, 13, 23), Pa. All zero: at rest so far.
inline std::size_t viscous_state_size(std::size_t terms) {
  return 6 * (1 + terms);
}

/// The relaxed isochoric P, Pa, from the elastic isochoric P (3 × 3, Pa) at the end of the step; carries the state over
/// the step. `state` has viscous_state_size(step.terms.size()) entries. J must be positive.
Eigen::Matrix3d relaxed_stress(const PronyStep& step, const Eigen::Matrix3d& isochoric_stress, const Deformation& d,
                               std::span<double> state);

/// law.isochoric_stress(d), relaxed.
template <class OneLaw>
Eigen::Matrix3d viscous_stress(const OneLaw& law, const PronyStep& step, const Deformation& d,
                               std::span<double> state) {
  return relaxed_stress(step, law.isochoric_stress(d), d, state);
}

/// Small strains do not tell the stresses apart: P itself relaxes, and stays symmetric.
inline Eigen::Matrix3d viscous_stress(const LinearElastic& law, const PronyStep& step, const Deformation& d,
                                      std::span<double> state) {
  return relaxed_stress(step, law.isochoric_stress(d), Deformation(Eigen::Matrix3d::Identity()), state);
}

}  // namespace brainshift::solve
