// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "solve/dynamics/relaxation_rules.hpp"

namespace brainshift::solve {

/// What the steps of a start near the end are damped for. That is A_0 as it is held, which suits what a smooth change
/// of the load leaves open. A rough change, as of points that each moved by themselves, leaves slower motions, too.
/// What is still far from rest after a few steps, or not at rest after more, is therefore damped by turns: for less
/// than A_0, which brings slow motions down but lets quicker ones swing, then for more, under which these die and the
/// bound of the error shows it.
class DampingTurns {
 public:
  static constexpr int if_far = 24, at_the_latest = 60;  // steps after which they begin
  static constexpr int slow_steps = 48, quick_steps = 40, rounds = 2;
  static_assert(if_far % settled_window == 0 && at_the_latest % settled_window == 0, "looks see them begin");

  /// At a look. far: what spans say is left, of a state that is damped for more than its A_0.
  template <class IsFar>
  void begin_if_due(int steps, const IsFar& is_far) {
    if (!are_on(steps) && (steps == at_the_latest || (steps == if_far && is_far()))) {
      begin_ = steps;
    }
  }

  /// Whether the step after so many is one of a turn.
  bool are_on(int steps) const { return begin_ > 0 && steps >= begin_ && steps < begin_ + rounds * round; }

  /// Whether what is left can be told after so many steps. Slow motions gather speed in the turns that are damped for
  /// less, so that what they went last tells too little.
  bool may_end(int steps) const { return !is_slow(steps - 1); }

  /// The eigenvalue that it is damped for. lowest: A_0 as held.
  double eigenvalue(double lowest, int steps) const {
    return are_on(steps) ? bounded_eigenvalue((is_slow(steps) ? slower : quicker) * lowest) : lowest;
  }

  /// The largest that steps from after `from` to after `to` are damped for.
  double largest_eigenvalue(double lowest, int from, int to) const {
    double largest = 0;
    for (int steps = std::max(from, 0); steps < to; steps += settled_window) {
      largest = std::max(largest, eigenvalue(lowest, steps));
    }
    return largest;
  }

  /// Rate a step of the slowest motion that may then be left; 0 where it is that of the damping itself.
  double slowest(double lowest, int steps) const {
    return are_on(steps) ? slowest_rate(critical_beta(eigenvalue(lowest, steps)), left * lowest) : 0;
  }

 private:
  bool is_slow(int steps) const { return are_on(steps) && (steps - begin_) % round < slow_steps; }

  static constexpr int round = slow_steps + quick_steps;
  static constexpr double slower = 0.24, quicker = 1.6;  // than A_0
  static constexpr double left = 0.48;                   // of A_0: what a slow turn has brought down is slower

  int begin_ = 0;
};

}  // namespace brainshift::solve
