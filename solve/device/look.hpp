// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/boundary_step.hpp"
#include "solve/dynamics/span_bound.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve::device {

BRAINSHIFT_ON_DEVICE inline double square(double x) {
  return x * x;
}

/// What is known of the nodes: û, their last steps, the forces.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void look_at_nodes(const Team& team, const View<Scalar>& v, const Order& order, const Motion& m,
                                        double (&of)[LookSums::count]) {
  using Sums = LookSums;
  const auto state = [&](int looks_on) {
    return v.span_state + 4 * static_cast<std::int64_t>(v.nodes) * ((order.states + looks_on) % (2 * order.span + 1));
  };
  const double *first = state(1), *middle = state(1 + order.span);
  double* last = state(0);
  for (std::int32_t a = first_of_all(team); a < v.nodes; a += all_threads(team)) {
    const double mass = v.mass[a];
    double moved = 0, push = 0, force = 0, went = 0, went_before = 0;
    for (std::int64_t i = 4 * static_cast<std::int64_t>(a); i < 4 * static_cast<std::int64_t>(a) + 3; ++i) {
      const double step = m.now[i] - m.before[i], step_before = m.before[i] - m.next[i];
      of[Sums::stiffness] += step_before * (m.force[i] - m.force_before[i]);
      of[Sums::inertia_before] += mass * square(step_before);
      of[Sums::inertia_now] += mass * square(step);
      of[Sums::inertia_two] += mass * square(m.now[i] - m.next[i]);
      of[Sums::window_stiffness] += (m.before[i] - v.place_at_look[i]) * (m.force[i] - v.force_at_look[i]);
      of[Sums::window_inertia] += mass * square(m.before[i] - v.place_at_look[i]);
      moved += square(step);
      push += square(mass * (step - order.beta * step_before));
      force += square(m.force[i]);
      went += square(m.now[i] - middle[i]);
      went_before += square(middle[i] - first[i]);
      of[Sums::span_product] += (m.now[i] - middle[i]) * (middle[i] - first[i]);
      of[Sums::farthest] = larger(of[Sums::farthest], std::abs(m.now[i]));
      v.place_at_look[i] = m.before[i];
      v.force_at_look[i] = m.force[i];
      last[i] = m.now[i];
    }
    of[Sums::longest_step] = larger(of[Sums::longest_step], moved);
    of[Sums::push] += std::sqrt(push) / order.alpha;
    of[Sums::force] += std::sqrt(force);
    of[Sums::span_squares] += went_before;
    of[Sums::span_longest] = larger(of[Sums::span_longest], std::sqrt(went));
    of[Sums::span_of_nodes] =
        larger(of[Sums::span_of_nodes], SpanBound::of_node(std::sqrt(went), std::sqrt(went_before)));
  }
}

template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void look_at_conditions(const Team& team, const View<Scalar>& v, const Motion& m,
                                             double (&of)[LookSums::count]) {
  for (int axis = 0; axis < 3; ++axis) {
    const Conditions& c = v.condition[axis];
    for (std::int32_t i = first_group(team); i < c.count; i += all_groups(team)) {
      const double multiplier = m.multiplier_of[axis][i];
      const double moved =
          c.compliance == nullptr ? 0 : along_row(team, c, i, m.now, axis) - along_row(team, c, i, m.before, axis);
      if (team.thread() % Team::wide == 0) {
        of[LookSums::reaction_x + axis] += multiplier * c.loaded[i];
        of[LookSums::spring_work] -= moved * (multiplier - m.multiplier_before[axis][i]);
      }
    }
  }
}

/// As point_state(), at the last force.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void look_at_points(const Team& team, const View<Scalar>& v, const Motion& m,
                                         double (&of)[LookSums::count]) {
  using Sums = LookSums;
  const Room<Scalar> room(team.room(), v);
  for (int i = team.block(); i < v.clusters; i += team.blocks()) {
    const Cluster& c = v.cluster[i];
    find_gradients(team, v, i, m.before, 1, room);
    const double minus_smallest = find_dilatations(team, v, c, room);
    of[Sums::minus_jacobian] = larger(of[Sums::minus_jacobian], minus_smallest);
    for (std::int32_t p = team.thread(); p < c.points; p += team.threads()) {
      const std::int32_t point = c.first_point + p, material = v.material[point];
      const Deformation d(room.gradient(p));
      const double seen = seen_at(v, c, room, point), volume = v.volume[point];
      of[Sums::strain_energy] += volume * visit(v.law[material], [&](const auto& law) {
                                   return law.isochoric_energy(d) + point_energy(law, seen, law.dilatation(d));
                                 });
      const bool pressed = visit(v.law[material], [&](const auto& law) {
        return law.bulk_modulus * std::abs(seen) > most_pressure * law.shear_modulus;
      });
      const Eigen::Vector3d stretches = principal_stretches(d.gradient);
      of[Sums::stretch] = larger(of[Sums::stretch], stretches[2]);
      of[Sums::compressed] += stretches[0] < crease_stretch ? volume : 0;
      of[Sums::pressed + material] += pressed ? volume : 0;
    }
    team.sync_block();
  }
}

/// m: after the last step, with its force and multipliers.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void look(const Team& team, const View<Scalar>& v, const Order& order, const Motion& m) {
  double of[LookSums::count] = {};
  of[LookSums::minus_jacobian] = -1;
  of[LookSums::stretch] = 1;
  look_at_nodes(team, v, order, m, of);
  if (!order.glance) {
    look_at_conditions(team, v, m, of);
    look_at_points(team, v, m, of);
  }
  leave<LookSums::sums>(team, of, v.partial);
  team.sync_all();
  if (team.block() == 0) {
    collect<LookSums::sums, LookSums::count>(team, v.partial, v.record->look.of);
  }
}

}  // namespace brainshift::solve::device
