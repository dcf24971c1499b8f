// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/each/boundary.hpp"
#include "solve/device/each/follow.hpp"
#include "solve/device/each/look.hpp"
#include "solve/device/each/weigh.hpp"

namespace brainshift::solve::device {

/// EachMotion::step() as often as the order says, or until a point of a member is squeezed so much that its masses must
/// be looked at.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void step(const Team& team, const ViewOfEach<Scalar>& v, const OrderOfEach& order) {
  int done = 0;
  Members halted = 0;
  while (done < order.steps && halted == 0) {
    const MotionOfEach motion = motion_of_each(v, order.first + done, order.parity + done);
    Gathered<Team, StepOfEach::count> sums;
    for (double& of_member : sums.of[StepOfEach::minus_jacobian]) {
      of_member = -1;
    }
    find_dilatations(team, v, order.who, motion.now, sums.of[StepOfEach::minus_jacobian]);
    sum_step(team, v, order.who, motion, sums);
    leave_each<StepOfEach::sums>(team, sums, v.partial);
    team.sync_all();
    find_stresses(team, v, order.who);
    record_step(team, v, order.who, done);
    team.sync_all();
    find_slot_forces(team, v, order.who);
    team.sync_all();
    move_nodes(team, v, order, motion, v.fraction + at_member(done, 0));
    team.sync_all();
    const auto& minus_jacobian = v.record->step[done].of[StepOfEach::minus_jacobian];
    halted = team.which(order.who, [&](int m) { return !(-minus_jacobian[m] >= order.halt_below[m]); });
    if (v.contact.count > 0) {
      touch(team, v, order.who, motion.next);
    }
    hold(team, v, order.who, motion, v.fraction + at_member(done + 1, 0));
    ++done;
  }
  Gathered<Team, StepOfEach::count> sums;
  sum_step(team, v, order.who, motion_of_each(v, order.first + done, order.parity + done), sums);
  leave_each<StepOfEach::sums>(team, sums, v.partial);
  team.sync_all();
  record_step(team, v, order.who, done);
  if (first_of_each(team) == 0 && team.leads()) {
    v.record->steps = done;
    v.record->halted = halted;
  }
}

/// At the state that the next step would begin with, unless the last order has halted.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void look_if_due(const Team& team, const ViewOfEach<Scalar>& v, const OrderOfEach& order) {
  if (v.record->halted == 0) {
    look(team, v, order, motion_of_each(v, order.first, order.parity + 1));  // with the last force: they come in turn
  }
}

/// Sums over the nodes that every thread gets of its own members.
template <int count, class Team>
BRAINSHIFT_ON_DEVICE void sum_for_all(const Team& team, Members who, Gathered<Team, count>& sums, double* partial) {
  leave_each<count>(team, sums, partial);
  team.sync_all();
  sums = {};
  team.for_each(who, [&](int m) {
    BRAINSHIFT_AHEAD
    for (int b = 0; b < team.blocks(); ++b) {
      BRAINSHIFT_UNROLLED
      for (int k = 0; k < count; ++k) {
        sums.at(k, m) += partial[at_member(static_cast<std::int64_t>(b) * count + k, m)];
      }
    }
  });
  team.sync_all();
}

/// As bound_tightness_of_each(), for the masses in `stiffer_mass`, from the mode in `mode_of_body`.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void measure_tightness(const Team& team, const ViewOfEach<Scalar>& v, const OrderOfEach& order) {
  const std::int64_t values = 3 * static_cast<std::int64_t>(v.nodes);
  Gathered<Team, 1> squares;
  for (std::int64_t i = first_of_each(team); i < values; i += all_of_each(team)) {
    team.for_each(order.who, [&](int m) {
      const double mode = v.mode_of_body[at_member(i, m)];
      squares.at(0, m) += mode * mode;
    });
  }
  sum_for_all(team, order.who, squares, v.partial);
  double minus_smallest[Team::own] = {};
  for (int iteration = 0; iteration < order.iterations; ++iteration) {
    for (std::int64_t i = first_of_each(team); i < values; i += all_of_each(team)) {
      team.for_each(order.who, [&](int m) {
        v.mode_of_body[at_member(i, m)] *=
            order.mode_size * std::sqrt(static_cast<double>(v.nodes)) / std::sqrt(squares.at(0, m));
      });
    }
    team.sync_all();
    find_dilatations(team, v, order.who, v.mode_of_body, minus_smallest);
    team.sync_all();
    find_stresses(team, v, order.who);
    team.sync_all();
    find_slot_forces(team, v, order.who);
    team.sync_all();
    Gathered<Team, 3> sums;
    for (std::int32_t a = first_of_each(team); a < v.nodes; a += all_of_each(team)) {
      team.for_each(order.who, [&](int m) {
        double force[3];
        sum_slot_forces(v, a, m, force);
        const double mass = v.stiffer_mass[at_member(a, m)];
        BRAINSHIFT_UNROLLED
        for (int axis = 0; axis < 3; ++axis) {
          const std::int64_t i = at_member(3 * static_cast<std::int64_t>(a) + axis, m);
          const double mode = v.mode_of_body[i], after = force[axis] / mass;
          sums.at(0, m) += mode * force[axis];
          sums.at(1, m) += mass * mode * mode;
          sums.at(2, m) += after * after;
          v.mode_of_body[i] = after;
        }
      });
    }
    sum_for_all(team, order.who, sums, v.partial);
    team.for_each(order.who, [&](int m) {
      squares.at(0, m) = sums.at(2, m);
      if (first_of_each(team) == 0) {
        v.record->eigenvalue[m] = sums.at(0, m) / sums.at(1, m);
      }
    });
  }
}

template <TaskOfEach task, class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void perform(const Team& team, const ViewOfEach<Scalar>& v, const OrderOfEach& order) {
  const MotionOfEach motion = motion_of_each(v, order.first, order.parity);
  if constexpr (task == TaskOfEach::step) {
    step(team, v, order);
  } else if constexpr (task == TaskOfEach::look) {
    look_if_due(team, v, order);
  } else if constexpr (task == TaskOfEach::follow) {
    follow_stiffness(team, v, order, motion);
  } else if constexpr (task == TaskOfEach::weigh) {
    weigh(team, v, order);
  } else if constexpr (task == TaskOfEach::hold) {
    hold(team, v, order.who, motion, v.fraction);
  } else if constexpr (task == TaskOfEach::measure_tightness) {
    measure_tightness(team, v, order);
  } else {
    measure_energy(team, v, order.who, motion);
  }
}

/// Calls use.template operator()<task>() of a task that is known when the program runs.
template <class Use>
void with_task(TaskOfEach task, const Use& use) {
  switch (task) {
    case TaskOfEach::step:
      return use.template operator()<TaskOfEach::step>();
    case TaskOfEach::look:
      return use.template operator()<TaskOfEach::look>();
    case TaskOfEach::follow:
      return use.template operator()<TaskOfEach::follow>();
    case TaskOfEach::weigh:
      return use.template operator()<TaskOfEach::weigh>();
    case TaskOfEach::hold:
      return use.template operator()<TaskOfEach::hold>();
    case TaskOfEach::measure_tightness:
      return use.template operator()<TaskOfEach::measure_tightness>();
    case TaskOfEach::measure_energy:
      return use.template operator()<TaskOfEach::measure_energy>();
  }
}

}  // namespace brainshift::solve::device
