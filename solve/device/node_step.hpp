// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "solve/device/cluster_force.hpp"

namespace brainshift::solve::device {

/// û over the last steps, and the force that belongs to `now`.
struct Motion {
  double *now, *before, *next;
  double *force, *force_before;
  double *multiplier_of[3], *multiplier_before[3];
};

/// first: as Order::first. parity: of the force and the multipliers, which the next step makes anew.
template <class Scalar>
BRAINSHIFT_ON_DEVICE Motion motion_at(const View<Scalar>& v, int first, int parity) {
  Motion m;
  m.now = v.displacement[first % 3];
  m.before = v.displacement[(first + 2) % 3];
  m.next = v.displacement[(first + 1) % 3];
  m.force = v.force_at[parity % 2];
  m.force_before = v.force_at[1 - parity % 2];
  for (int axis = 0; axis < 3; ++axis) {
    m.multiplier_of[axis] = v.condition[axis].multiplier[parity % 2];
    m.multiplier_before[axis] = v.condition[axis].multiplier[1 - parity % 2];
  }
  return m;
}

/// As ExternalForce::subtract() has it, of a component of a node: i counts them, 4 a node.
template <class Scalar>
BRAINSHIFT_ON_DEVICE double external_force(const View<Scalar>& v, double fraction, std::int64_t i) {
  if (v.external_count == 0) {
    return 0;
  }
  const double place = fraction * v.external_count;
  const int upper = static_cast<int>(std::min(std::max(std::floor(place), 0.0), v.external_count - 1.0));
  const double share = place - upper;
  const double* of_upper = v.external + 4 * static_cast<std::int64_t>(v.nodes) * upper;
  const double lower = upper > 0 ? (of_upper - 4 * static_cast<std::int64_t>(v.nodes))[i] : 0;
  return share * of_upper[i] + (1 - share) * lower;
}

/// What a thread has of the sums of the steps taken.
struct ThreadSums {
  double of[StepSums::count] = {};

  /// Of the first step, or of another.
  BRAINSHIFT_ON_DEVICE void add(bool first, double step_before, double two_steps, double push_work, double force_work) {
    of[StepSums::first_before] += first ? step_before : 0;
    of[StepSums::two_steps] += two_steps;
    of[StepSums::two_steps_last] = two_steps;
    of[StepSums::push_work] += push_work;
    of[StepSums::push_work_last] = push_work;
    of[StepSums::force_work] += force_work;
    of[StepSums::force_work_last] = force_work;
  }
  /// rate: of the reactions' work by the load's fraction, which moved on by so much before the step.
  BRAINSHIFT_ON_DEVICE void add_reactions(bool first, double moved_on, double rate) {
    of[StepSums::rate_first] += first ? rate : 0;
    of[StepSums::reaction_work] += first ? 0 : moved_on * (rate + of[StepSums::rate_last]) / 2;
    of[StepSums::rate_last] = rate;
  }
};

/// The sums of the step of an order, the first is 1, that has led to `m`.now, as threads go through the nodes.
template <class Scalar>
class StepTaken {
 public:
  BRAINSHIFT_ON_DEVICE StepTaken(const View<Scalar>& v, const Order& order, const Motion& m, int step)
      : v_(v), m_(m), step_(step), from_(order.fraction[step > 0 ? step - 1 : 0]), to_(order.fraction[step]) {}

  /// Of a component of a node.
  BRAINSHIFT_ON_DEVICE void add(std::int64_t i, double now, double before) {
    if (step_ > 0) {
      const double mass = v_.mass[i / 4], earlier = m_.next[i];
      two_steps_ += mass * (now - earlier) * (now - earlier);
      step_before_ += mass * (before - earlier) * (before - earlier);
      push_work_ += v_.contact.count > 0 ? v_.contact.pushed[i] * (now - earlier) / 2 : 0;
      if (v_.external_count > 0) {
        force_work_ += (external_force(v_, from_, i) + external_force(v_, to_, i)) / 2 * (now - before);
      }
    }
  }
  BRAINSHIFT_ON_DEVICE void end(ThreadSums& sums) const {
    if (step_ > 0) {
      sums.add(step_ == 1, step_before_, two_steps_, push_work_, force_work_);
    }
  }

 private:
  const View<Scalar>& v_;
  const Motion& m_;
  int step_;
  double from_, to_;
  double step_before_ = 0, two_steps_ = 0, push_work_ = 0, force_work_ = 0;
};

/// û⁺ = û + β(û − û⁻) + α M⁻¹ (f_ext − f_int), each component of a node by itself, after so many steps of the order.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void move_nodes(const Team& team, const View<Scalar>& v, const Order& order, const Motion& m,
                                     int done, ThreadSums& sums) {
  StepTaken<Scalar> taken(v, order, m, done);
  for (std::int64_t i = first_of_all(team); i < 4 * static_cast<std::int64_t>(v.nodes); i += all_threads(team)) {
    const auto node = static_cast<std::int32_t>(i / 4);
    const int axis = static_cast<int>(i % 4);
    if (axis < 3) {
      const double now = m.now[i], before = m.before[i];
      taken.add(i, now, before);
      const double force = force_at_node(v, node, axis) - external_force(v, order.fraction[done], i);
      m.force[i] = force;
      m.next[i] = now + order.beta * (now - before) - order.alpha * v.inverse_mass[node] * force;
    }
  }
  taken.end(sums);
}

/// The sums of the last step.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void add_last_step(const Team& team, const View<Scalar>& v, const Order& order, const Motion& m,
                                        int done, ThreadSums& sums) {
  StepTaken<Scalar> taken(v, order, m, done);
  for (std::int64_t i = first_of_all(team); i < 4 * static_cast<std::int64_t>(v.nodes); i += all_threads(team)) {
    taken.add(i, m.now[i], m.before[i]);
  }
  taken.end(sums);
}

}  // namespace brainshift::solve::device
