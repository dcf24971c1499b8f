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

/// û⁺ = û + β(û − û⁻) + α M⁻¹ (f_ext − f_int), each component of a node by itself.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void move_nodes(const Team& team, const View<Scalar>& v, const Order& order, const Motion& m,
                                     double fraction) {
  for (std::int64_t i = first_of_all(team); i < 4 * static_cast<std::int64_t>(v.nodes); i += all_threads(team)) {
    const auto node = static_cast<std::int32_t>(i / 4);
    const int axis = static_cast<int>(i % 4);
    if (axis < 3) {
      const double force = force_at_node(v, node, axis) - external_force(v, fraction, i);
      m.force[i] = force;
      m.next[i] = m.now[i] + order.beta * (m.now[i] - m.before[i]) - order.alpha * v.inverse_mass[node] * force;
    }
  }
}

/// The sums of the step that has led to `m`.now, on which the load went from one fraction to another. minus_jacobian:
/// of the force after it.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void leave_step_sums(const Team& team, const View<Scalar>& v, const Motion& m, double from,
                                          double to, double minus_jacobian) {
  double of[StepSums::count] = {};
  for (std::int64_t i = first_of_all(team); i < 4 * static_cast<std::int64_t>(v.nodes); i += all_threads(team)) {
    const double mass = v.mass[i / 4];
    const double both = m.now[i] - m.next[i], before = m.before[i] - m.next[i];
    of[StepSums::two_steps] += mass * both * both;
    of[StepSums::step_before] += mass * before * before;
    of[StepSums::force_work] += (external_force(v, from, i) + external_force(v, to, i)) / 2 * (m.now[i] - m.before[i]);
  }
  for (std::int32_t i = first_group(team); i < v.contact.count; i += all_groups(team)) {
    const double* push = v.contact.push + 3 * i;
    if (push[0] == 0 && push[1] == 0 && push[2] == 0) {
      continue;
    }
    for (std::int64_t k = v.contact.begin[i] + team.thread() % Team::wide; k < v.contact.begin[i + 1];
         k += Team::wide) {
      const std::int64_t node = 4 * static_cast<std::int64_t>(v.contact.node[k]);
      for (int axis = 0; axis < 3; ++axis) {
        of[StepSums::push_work] += push[axis] * v.contact.shape[k] * (m.now[node + axis] - m.next[node + axis]) / 2;
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Conditions& c = v.condition[axis];
    for (std::int32_t i = first_of_all(team); i < c.count; i += all_threads(team)) {
      of[StepSums::multiplier_work] += m.multiplier_before[axis][i] * c.prescribed[i];
    }
  }
  of[StepSums::minus_jacobian] = minus_jacobian;
  leave<StepSums::sums>(team, of, v.partial);
}

}  // namespace brainshift::solve::device
