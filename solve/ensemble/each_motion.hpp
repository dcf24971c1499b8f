// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "solve/body/body.hpp"
#include "solve/ensemble/each_conditions.hpp"
#include "solve/ensemble/each_contact.hpp"
#include "solve/ensemble/each_force.hpp"
#include "solve/ensemble/member.hpp"

namespace brainshift::solve {

/// Motion of the members of an ensemble: their parameters over the last steps, and as much of their energies as tells
/// that one has blown up. A step is that of Motion.
class EachMotion {
 public:
  EachMotion(const Body& body, std::span<const Member> loads);

  /// f_int at `now`.
  void find_force() { force_law.find(now, force); }

  /// One step to `time`, where `fraction` of the load holds. mass: as last given to weigh().
  void step(const EachNumbers& mass, const NumberOfEach<double>& beta, double time, double fraction,
            const Chosen& active);

  /// As Motion::weigh(), of the chosen members.
  void weigh(const EachNumbers& mass, const Chosen& chosen);

  /// As Motion::start_from(), each its own.
  void start_from(std::span<const Member> loads);

  /// Largest |component| of û of each member, mm; NaN where one is.
  Numbers farthest() const;

  /// Rayleigh's quotient of the change from a place and its force to `before` and its force; not above 0: it does not
  /// tell.
  Numbers eigenvalue_since(const EachVectors& place, const EachVectors& force_there, const EachNumbers& mass) const;

  /// The share of conditions that give way in A_0; 0 where there are none.
  Numbers spring_stiffness(const EachNumbers& mass) const;

  /// Energy of the motion over the most that it can have.
  Numbers motion_over_work(const EachNumbers& mass);

  /// A member that has ended, or is not there, lies undeformed and without load.
  void let_go(std::size_t member);

  EachForce force_law;
  EachVectors now, before, next;    ///< û, as in Motion
  EachVectors force, force_before;  ///< f_int − f_ext at `before`, and as relaxation swaps it; µN
  int steps = 0;
  double time = 0;

 private:
  Numbers force_work(double share) const;
  Numbers inertia(const EachNumbers& mass, const EachVectors& x, const EachVectors& y) const;  // Σ m |x − y|²

  EachConditions essential_;
  std::optional<EachContact> contact_;
  EachVectors external_;  // under the whole load, µN; empty: none
  double fraction_ = 0, fraction_before_ = 0;
  NumberOfEach<double> beta_ = {};  // of the last step
  Numbers work_rate_ = Numbers::Zero(), force_work_ = Numbers::Zero();
  Numbers external_work_ = Numbers::Zero(), largest_work_ = Numbers::Zero();
  Numbers rounding_energy_;
};

}  // namespace brainshift::solve
