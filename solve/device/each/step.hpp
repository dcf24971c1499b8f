// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/each/force.hpp"

namespace brainshift::solve::device {

/// û over the last steps, and the force and multipliers that belong to `now`.
struct MotionOfEach {
  double *now, *before, *next;
  double *force, *force_before;
  double *multiplier[3], *multiplier_before[3];
};

/// first, parity: as in Order.
template <class Scalar>
BRAINSHIFT_ON_DEVICE MotionOfEach motion_of_each(const ViewOfEach<Scalar>& v, int first, int parity) {
  MotionOfEach motion;
  motion.now = v.displacement[first % 3];
  motion.before = v.displacement[(first + 2) % 3];
  motion.next = v.displacement[(first + 1) % 3];
  motion.force = v.force_at[parity % 2];
  motion.force_before = v.force_at[1 - parity % 2];
  for (int axis = 0; axis < 3; ++axis) {
    motion.multiplier[axis] = v.condition[axis].multiplier[parity % 2];
    motion.multiplier_before[axis] = v.condition[axis].multiplier[1 - parity % 2];
  }
  return motion;
}

/// Rows of the three components, or nodes that they move, counted one after the other.
struct AllComponents {
  std::int32_t begin[4];

  template <class Scalar>
  BRAINSHIFT_ON_DEVICE AllComponents(const ViewOfEach<Scalar>& v, std::int32_t SparseRows::*count) {
    begin[0] = 0;
    for (int axis = 0; axis < 3; ++axis) {
      begin[axis + 1] = begin[axis] + v.condition[axis].*count;
    }
  }
  BRAINSHIFT_ON_DEVICE int axis_of(std::int32_t i) const { return i < begin[1] ? 0 : i < begin[2] ? 1 : 2; }
};

/// û⁺ = û + β(û − û⁻) − α M⁻¹ (f_int − fraction f_ext).
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void move_nodes(const Team& team, const ViewOfEach<Scalar>& v, const OrderOfEach& order,
                                     const MotionOfEach& motion, const double* fraction) {
  for (std::int32_t a = first_of_each(team); a < v.nodes; a += all_of_each(team)) {
    team.for_each(order.who, [&](int m) {
      double force[3];
      sum_slot_forces(v, a, m, force);
      const double push = order.alpha * v.inverse_mass[at_member(a, m)];
      BRAINSHIFT_UNROLLED
      for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t i = at_member(3 * static_cast<std::int64_t>(a) + axis, m);
        const double net = v.external == nullptr ? force[axis] : force[axis] - fraction[m] * v.external[i];
        const double now = motion.now[i];
        motion.force[i] = net;
        motion.next[i] = now + order.beta[m] * (now - motion.before[i]) - push * net;
      }
    });
  }
}

/// Sums of the step that has led to `now`.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void sum_step(const Team& team, const ViewOfEach<Scalar>& v, Members who,
                                   const MotionOfEach& motion, Gathered<Team, StepOfEach::count>& sums) {
  for (std::int32_t a = first_of_each(team); v.external != nullptr && a < v.nodes; a += all_of_each(team)) {
    team.for_each(who, [&](int m) {
      BRAINSHIFT_UNROLLED
      for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t i = at_member(3 * static_cast<std::int64_t>(a) + axis, m);
        sums.at(StepOfEach::force_work, m) += v.external[i] * (motion.now[i] - motion.before[i]);
      }
    });
  }
  const AllComponents rows(v, &SparseRows::count);
  for (std::int32_t i = first_of_each(team); i < rows.begin[3]; i += all_of_each(team)) {
    const int axis = rows.axis_of(i);
    team.for_each(who, [&](int m) {
      const std::int64_t row = at_member(i - rows.begin[axis], m);
      sums.at(StepOfEach::multiplier_work, m) +=
          motion.multiplier_before[axis][row] * v.condition[axis].prescribed[row];
    });
  }
}

/// Puts together what the blocks have left of a step's sums, by the last block.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void record_step(const Team& team, const ViewOfEach<Scalar>& v, Members who, int step) {
  if (team.block() == team.blocks() - 1) {
    StepOfEach& to = v.record->step[step];
    collect_each<StepOfEach::sums, StepOfEach::count>(team, who, v.partial,
                                                      [&](int k, int m, double x) { to.of[k][m] = x; });
  }
}

}  // namespace brainshift::solve::device
