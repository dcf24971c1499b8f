// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

namespace brainshift::solve {

/// How fast relaxation runs through the load's curve: in `load_steps` steps, but of a body that may tear as slowly as
/// it comes to rest.
class LoadPace {
 public:
  LoadPace(int load_steps, bool may_tear)
      : load_steps_(std::max(load_steps, 1)), may_tear_(may_tear), speed_(may_tear ? 0.0 : 1.0) {}

  /// Takes one step further along the curve; returns the share of it that is behind, 0 to 1. The speed changes evenly
  /// in proportion: a jump of it would be one of the inertia in the reactions. rests: the body is at rest.
  double go_on(bool rests) {
    if (may_tear_) {
      constexpr double faster = 1.01, slower = 0.99;
      speed_ *= rests ? faster : slower;
      speed_ = std::min(std::max(speed_, slowest_ * load_steps_), 1.0);
    }
    behind_ += speed_;
    return std::min(1.0, behind_ / load_steps_);
  }

  /// The whole curve is behind.
  void skip() { behind_ = load_steps_; }

  /// The body has torn: the load waits for the tear, which is much faster.
  void wait() { slowest_ = slowest_in_tearing; }

 private:
  // of the curve a step; the first steps are restless however slow the load is
  static constexpr double slowest_at_first = 1.0 / 30000, slowest_in_tearing = 1.0 / 300000;

  int load_steps_;
  bool may_tear_;
  double speed_;       // steps of load_steps a step
  double behind_ = 0;  // of load_steps
  double slowest_ = slowest_at_first;
};

}  // namespace brainshift::solve
