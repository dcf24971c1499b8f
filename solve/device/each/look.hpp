// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/each/boundary.hpp"
#include "solve/dynamics/span_bound.hpp"

namespace brainshift::solve::device {

/// What is known of a member at a node: û, its last steps, the forces.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void look_at_node(const ViewOfEach<Scalar>& v, const OrderOfEach& order,
                                       const MotionOfEach& motion, std::int32_t node, int m,
                                       Gathered<Team, LookOfEach::count>& sums) {
  using Sums = LookOfEach;
  const double *first = v.span_state[(order.states + 1) % 3], *middle = v.span_state[(order.states + 2) % 3];
  double* last = v.span_state[order.states % 3];
  const double mass = v.mass[at_member(node, m)];
  double moved = 0, went = 0, went_before = 0;
  const auto add_square = [](double& sum, double x) { sum += x * x; };
  BRAINSHIFT_UNROLLED
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t i = at_member(3 * static_cast<std::int64_t>(node) + axis, m);
    const double now = motion.now[i], before = motion.before[i], next = motion.next[i], force = motion.force[i];
    const double step_before = before - next, in_window = before - v.place_at_look[i];
    const double span = now - middle[i], span_before = middle[i] - first[i];
    sums.at(Sums::stiffness, m) += step_before * (force - motion.force_before[i]);
    sums.at(Sums::inertia_before, m) += mass * step_before * step_before;
    sums.at(Sums::inertia_now, m) += mass * (now - before) * (now - before);
    sums.at(Sums::inertia_two, m) += mass * (now - next) * (now - next);
    sums.at(Sums::window_stiffness, m) += in_window * (force - v.force_at_look[i]);
    sums.at(Sums::window_inertia, m) += mass * in_window * in_window;
    sums.at(Sums::span_product, m) += span * span_before;
    add_square(moved, now - before);
    add_square(went, span);
    add_square(went_before, span_before);
    sums.at(Sums::farthest, m) = larger(sums.at(Sums::farthest, m), std::abs(now));
    v.place_at_look[i] = before;
    v.force_at_look[i] = force;
    last[i] = now;
  }
  sums.at(Sums::span_squares, m) += went_before;
  sums.at(Sums::longest_step, m) = larger(sums.at(Sums::longest_step, m), moved);
  went = std::sqrt(went);
  sums.at(Sums::span_longest, m) = larger(sums.at(Sums::span_longest, m), went);
  sums.at(Sums::span_of_nodes, m) =
      larger(sums.at(Sums::span_of_nodes, m), SpanBound::of_node(went, std::sqrt(went_before)));
}

/// Of conditions that give way.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void look_at_springs(const Team& team, const ViewOfEach<Scalar>& v, Members who,
                                          const MotionOfEach& motion, Gathered<Team, LookOfEach::count>& sums) {
  for (int axis = 0; axis < 3; ++axis) {
    const ConditionsOfEach& c = v.condition[axis];
    for (std::int32_t row = first_of_each(team); c.compliance != nullptr && row < c.count; row += all_of_each(team)) {
      team.for_each(who, [&](int m) {
        const double moved = along_row(c, row, motion.now, axis, m) - along_row(c, row, motion.before, axis, m);
        const std::int64_t i = at_member(row, m);
        sums.at(LookOfEach::spring_work, m) -= moved * (motion.multiplier[axis][i] - motion.multiplier_before[axis][i]);
      });
    }
  }
}

/// motion: after the last step, with its force and multipliers.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void look(const Team& team, const ViewOfEach<Scalar>& v, const OrderOfEach& order,
                               const MotionOfEach& motion) {
  Gathered<Team, LookOfEach::count> sums;
  for (std::int32_t a = first_of_each(team); a < v.nodes; a += all_of_each(team)) {
    team.for_each(order.who, [&](int m) { look_at_node<Team>(v, order, motion, a, m, sums); });
  }
  look_at_springs(team, v, order.who, motion, sums);
  leave_each<LookOfEach::sums>(team, sums, v.partial);
  team.sync_all();
  if (team.block() == 0) {
    collect_each<LookOfEach::sums, LookOfEach::count>(team, order.who, v.partial,
                                                      [&](int k, int m, double x) { v.record->look.of[k][m] = x; });
  }
}

/// As point_state().strain_energy, of the state `now`.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void measure_energy(const Team& team, const ViewOfEach<Scalar>& v, Members who,
                                         const MotionOfEach& motion) {
  double minus_smallest[Team::own] = {};
  find_dilatations(team, v, who, motion.now, minus_smallest);
  team.sync_all();
  Gathered<Team, 1> energy;
  for (std::int32_t i = first_of_each(team); i < v.pieces; i += all_of_each(team)) {
    const Piece piece = v.piece[i];
    const PatchOfPieces patch = v.patch[piece.patch];
    team.for_each(who, [&](int m) {
      const SeenByPatch seen(v, patch, m);
      for (std::int32_t p = piece.first_point; p < piece.first_point + piece.points; ++p) {
        const Deformation d = deformation_at(v, p, m);
        const double seen_here = seen.at(v, p);
        energy.at(0, m) += v.volume[p] * ask_law(v, patch.material, m, [&](const auto& law) {
                             return law.isochoric_energy(d) + point_energy(law, seen_here, law.dilatation(d));
                           });
      }
    });
  }
  leave_each<1>(team, energy, v.partial);
  team.sync_all();
  if (team.block() == 0) {
    collect_each<1, 1>(team, who, v.partial, [&](int, int m, double x) { v.record->energy[m] = x; });
  }
}

}  // namespace brainshift::solve::device
