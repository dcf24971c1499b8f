// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/boundary_step.hpp"
#include "solve/device/follow.hpp"
#include "solve/device/look.hpp"
#include "solve/device/weigh.hpp"

namespace brainshift::solve::device {

/// What a team does in one go.
enum class Task : int { share_bounds, step, look, follow, weigh, hold, measure_tightness };

/// Motion::step() as often as the order says, or until a point is squeezed so much that the masses must be looked at.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void step(const Team& team, const View<Scalar>& v, const Order& order) {
  Record& record = *v.record;
  Room<Scalar> room(team.room(), v);
  keep_pairs(team, v, room);
  ThreadSums sums;
  int done = 0;
  bool halted = false;
  while (done < order.steps && !halted) {
    const Motion m = motion_at(v, order.first + done, order.parity + done);
    std::uint64_t* squeezed = record.squeezed + (order.parity + done) % 2;
    slot_forces(team, v, m.now, 1, room, squeezed);
    team.sync_all();
    move_nodes(team, v, order, m, done, sums);
    if (first_of_all(team) == 0) {
      record.squeezed[(order.parity + done + 1) % 2] = 0;
    }
    team.sync_all();
    if (v.contact.count > 0) {
      touch(team, v, m.next);
    }
    const double rate = hold(team, v, m, order.fraction[done + 1]);
    sums.add_reactions(done == 0, done > 0 ? order.fraction[done] - order.fraction[done - 1] : 0, rate);
    const double minus_jacobian = of_rising_key(*squeezed);
    halted = !(-minus_jacobian >= order.halt_below);
    if (first_of_all(team) == 0) {
      record.jacobian[done] = -minus_jacobian;
    }
    ++done;
  }
  add_last_step(team, v, order, motion_at(v, order.first + done, order.parity + done), done, sums);
  leave<StepSums::sums>(team, sums.of, v.partial);
  team.sync_all();
  if (team.block() == team.blocks() - 1) {
    collect<StepSums::sums, StepSums::count>(team, v.partial, record.steps_taken.of);
  }
  if (first_of_all(team) == 0) {
    record.steps = done;
    record.halted = halted ? 1 : 0;
  }
}

/// At the state that the next step would begin with, unless the last order has halted.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void look_if_due(const Team& team, const View<Scalar>& v, const Order& order) {
  if (v.record->halted == 0) {
    look(team, v, order, motion_at(v, order.first, order.parity + 1));  // with the last force: they come in turn
  }
}

/// Sums over the nodes that every thread gets. partial: another one than the last time.
template <int count, class Team>
BRAINSHIFT_ON_DEVICE void sum_for_all(const Team& team, double (&of)[count], double* partial) {
  leave<count>(team, of, partial);
  team.sync_all();
  for (int k = 0; k < count; ++k) {
    of[k] = of_all_blocks<count, count>(team, partial, k);
  }
}

/// largest_eigenvalue() for the masses in `stiffer_mass`, from the mode in `mode_of_body`, 4 a node.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void measure_tightness(const Team& team, const View<Scalar>& v, const Order& order) {
  Room<Scalar> room(team.room(), v);
  keep_pairs(team, v, room);
  const std::int64_t values = 4 * static_cast<std::int64_t>(v.nodes);
  double squares[1] = {};
  for (std::int64_t i = first_of_all(team); i < values; i += all_threads(team)) {
    squares[0] += square(v.mode_of_body[i]);
  }
  sum_for_all(team, squares, v.partial);
  double eigenvalue = 0;
  for (int iteration = 0; iteration < order.iterations; ++iteration) {
    const double scale = order.mode_size * std::sqrt(static_cast<double>(v.nodes)) / std::sqrt(squares[0]);
    slot_forces(team, v, v.mode_of_body, scale, room, nullptr);
    team.sync_all();
    double of[3] = {};
    for (std::int64_t i = first_of_all(team); i < values; i += all_threads(team)) {
      const double mass = v.stiffer_mass[i / 4], mode = scale * v.mode_of_body[i];
      const double force = i % 4 < 3 ? force_at_node(v, static_cast<std::int32_t>(i / 4), static_cast<int>(i % 4)) : 0;
      of[0] += mode * force;
      of[1] += mass * mode * mode;
      v.mode_of_body[i] = force / mass;
      of[2] += square(v.mode_of_body[i]);
    }
    sum_for_all(team, of, v.partial + (iteration + 1) % 2 * 3 * team.blocks());
    eigenvalue = of[0] / of[1];
    squares[0] = of[2];
  }
  if (first_of_all(team) == 0) {
    v.record->eigenvalue = eigenvalue;
  }
}

template <Task task, class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void perform(const Team& team, const View<Scalar>& v, const Order& order) {
  if constexpr (task == Task::share_bounds) {
    share_bounds(team, v);
  } else if constexpr (task == Task::step) {
    step(team, v, order);
  } else if constexpr (task == Task::look) {
    look_if_due(team, v, order);
  } else if constexpr (task == Task::follow) {
    follow_stiffness(team, v, order, motion_at(v, order.first, order.parity));
  } else if constexpr (task == Task::weigh) {
    weigh(team, v, order);
  } else if constexpr (task == Task::hold) {
    hold(team, v, motion_at(v, order.first, order.parity), order.fraction[0]);
  } else {
    measure_tightness(team, v, order);
  }
}

/// Calls use.template operator()<task>() of a task that is known when the program runs.
template <class Use>
void with_task(Task task, const Use& use) {
  switch (task) {
    case Task::share_bounds:
      return use.template operator()<Task::share_bounds>();
    case Task::step:
      return use.template operator()<Task::step>();
    case Task::look:
      return use.template operator()<Task::look>();
    case Task::follow:
      return use.template operator()<Task::follow>();
    case Task::weigh:
      return use.template operator()<Task::weigh>();
    case Task::hold:
      return use.template operator()<Task::hold>();
    case Task::measure_tightness:
      return use.template operator()<Task::measure_tightness>();
  }
}

}  // namespace brainshift::solve::device
