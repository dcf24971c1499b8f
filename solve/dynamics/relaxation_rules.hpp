// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "solve/force/point_laws.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

// What adaptive dynamic relaxation goes by, of one body and of an ensemble alike: relax() says what it means.

inline constexpr int usual_window = 20;      // steps between looks at the state
inline constexpr double far_from_rest = 10;  // bounds over the tolerance: nearer to the end nothing is gained
inline constexpr double mass_margin = 1.1;   // stiffness may grow by this before the masses are made anew

/// α of all steps. It stays the same: nodes in contact rest where a step's push and their way back cancel, which moves
/// with α. Stable up to 2(1 + β) for A_m = 1; the best, 4/(1 + √A_0)², would save an eighth of the steps.
inline constexpr double relaxation_alpha = 3;

/// β that makes the lowest mode decay fastest, by √β a step: its critical damping.
inline double critical_beta(double lowest_eigenvalue) {
  const double root = 1 - std::sqrt(relaxation_alpha * lowest_eigenvalue);
  return root * root;
}

inline constexpr double smallest_eigenvalue = 1e-8;

/// Rate a step of a mode of eigenvalue A: the larger root of λ² − (1 + β − αA)λ + β = 0, √β where it swings.
inline double slowest_rate(double beta, double eigenvalue) {
  const double half = (1 + beta - relaxation_alpha * eigenvalue) / 2, square = half * half - beta;
  return square > 0 ? half + std::sqrt(square) : std::sqrt(beta);
}

/// Rayleigh's quotient, an eigenvalue; 0 where nothing moved.
inline double rayleigh_quotient(double stiffness, double inertia) {
  return inertia > 0 ? stiffness / inertia : 0;
}

/// A_0 within what β allows: above the upper bound it is too small for α.
inline double bounded_eigenvalue(double eigenvalue) {
  return std::clamp(eigenvalue, smallest_eigenvalue, 0.028);
}

/// The eigenvalue that the steps after the nth are damped for. rough: of a start under the full load, which is full of
/// quick motions. Damped for a slow A_0 at once they outlast it, so each is damped first while it takes to die down: an
/// L of two layers, 144 : 1, ν = 0.4999, comes to rest after 36,500 steps in place of 65,480.
inline double damped_eigenvalue(double lowest, int n, bool rough) {
  const double frequency = rough ? 1.0 / (n + usual_window) : 0;
  return std::max(lowest, frequency * frequency);
}

/// Rate a step of the slowest motion under that damping; 0 where it is its own, which √β tells.
inline double damped_rate(double lowest, int n, bool rough) {
  return rough ? slowest_rate(critical_beta(damped_eigenvalue(lowest, n, rough)), lowest) : 0;
}

/// What the slowest rigid motion has still to go where the damping is for quicker ones, by what it went in the last
/// span of so many steps: at a rate that is known, as spans show it only once all else is at rest. of_rigid: its A_0.
inline double left_of_rigid(double went, int steps, double lowest, double of_rigid) {
  const double of_span = std::pow(slowest_rate(critical_beta(lowest), of_rigid), steps);
  return of_span / (1 - of_span) * went;
}

/// Windows between looks at the stiffness.
inline int windows_to_stiffness(bool loaded) {
  return loaded ? 10 : 3;
}

// What is other of a start near the end, Course::settled.

inline constexpr int settled_window = 2;   // steps between its looks
inline constexpr int settled_steps = 120;  // in which its A_0 is not estimated anew

/// Whether its look after so many steps is at the nodes alone. Near the end a state is hardly ever unsound, and a look
/// at the points costs half a step. Whether it is shows at the end at the latest.
inline bool only_glances(int steps, int most_steps) {
  constexpr int windows_of_a_row = 60;
  return steps / settled_window % windows_of_a_row != 0 && steps + settled_window <= most_steps;
}

/// Steps over the load's curve. Tissue that hardly changes its volume gives way by shear, √(K/µ) slower than by volume,
/// by which steps are measured. A load that comes sooner may fold it: a plate at ν = 0.499, pressed by a quarter in 400
/// steps, came to rest with a corner turned in, in 600 as it should. In plane stress the volume is free.
inline int steps_of_load(int asked, const PointLaws& laws) {
  constexpr double in_time = 100, slowest = 500;  // K / µ; beyond it random problems only took more steps
  double bulk = in_time;
  for (const auto& elastic : laws.elastic) {
    bulk = std::max(bulk, std::visit([](const auto& law) { return law.bulk_modulus / law.shear_modulus; }, elastic));
  }
  const double times = laws.plane_stress ? 1.0 : std::sqrt(std::min(bulk, slowest) / in_time);
  return static_cast<int>(std::min(asked * times, double{std::numeric_limits<int>::max()}));
}

/// A step of a node that is no longer than this is made of rounding, mm: along each axis of differences of sums of ten
/// terms and more. So is all that is shorter than places are known to, some 100 mm from the origin. farthest: largest
/// |component| of û.
inline double rounding_of_step(double farthest, Precision precision) {
  constexpr double terms = 10 * std::numbers::sqrt3, of_places = 1e-14;
  const double rounding = terms * farthest *
                          (precision == Precision::single_precision ? double{std::numeric_limits<float>::epsilon()}
                                                                    : std::numeric_limits<double>::epsilon());
  return std::max(rounding, of_places);
}

/// Whether a relaxation is so slow that single precision may bring it to rest farther off than is wanted, mm. Rounding
/// of forces moves the slowest motion by up to 6e-8 |û| / A_0, and a body takes some 4/√A_0 steps under the whole load.
/// A_0 itself does not tell it, as near the end that is of steps that are rounding. Plates a cell thick, which
/// ended 2.8 to 5.8 times their bound off, and blocks that single nodes hold (1.4 times) took 3,460 steps and more.
inline bool outlasts(Precision precision, int loaded_steps, double farthest, double wanted) {
  constexpr double of_rounding = 5e-10;  // a component, times the square of the steps: half of what is wanted at most
  const double steps = loaded_steps;
  return precision == Precision::single_precision && of_rounding * farthest * steps * steps > wanted;
}

/// Whether steps are so short that A_0, read off two of them, is too high: rounding stirs quick motions up, which count
/// there with their own eigenvalues. Of a ball with a stiff layer it rose from 3e-5 to 1e-4 where 6e-6 is right.
inline bool feels_rounding(double moved, double farthest, Precision precision) {
  constexpr double much_longer = 10;
  return moved < much_longer * rounding_of_step(farthest, precision);
}

}  // namespace brainshift::solve
