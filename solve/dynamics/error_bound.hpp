// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace brainshift::solve {

/// The bound of the error that relaxation leaves open, ρ/(1 − ρ) times the longest step of a node, with ρ the slower of
/// the measured rate a step and of the rate that the damping stands for. A passing low, as when the body swings through
/// a turning point, is no rest: the slowest rate of the last windows counts, and the largest of their bounds, each less
/// what a critically damped motion of that rate has lost since. Where motions are slow these windows are as many as
/// such motions take to die down. While A_0 falls, a slower motion than it tells of comes to light: what that has to go
/// is as much more as A_0 has become less, and the bound is that many times as large.
class ErrorBound {
 public:
  /// window: steps between two calls of add(). margin: what the bound is multiplied by.
  explicit ErrorBound(int window, double margin = 1) : window_(window), margin_(margin) {}

  /// moved: the longest way of a node, |u⁺ − u| or |û⁺ − û|, in the last step, mm; damping_rate: √β of A_0; loaded: the
  /// whole load is on; rounding: what no longer moves than this, mm, has no rate that could be measured; slowest: rate
  /// of A_0's motion where the damping is for quicker ones.
  void add(double moved, double damping_rate, bool loaded, double rounding = 0, double slowest = 0);

  /// mm; infinite until there are enough windows under the whole load.
  double value() const { return margin_ * value_; }

  /// mm; of a state of which SpanBound says of_spans. 13 of 300 random problems stopped farther from their end than
  /// the spans alone say, up to 2.7 times; 47 updates, which start near the end, were off by 0.86 of their bound at
  /// most.
  double with_spans(double of_spans, bool near_the_end = false) const;

  /// Steps without progress that are a standstill.
  static constexpr int standstill = 400;

  /// Steps under the whole load.
  int loaded_steps() const { return static_cast<int>(loaded_) * window_; }

  /// Whether steps under the whole load have stopped growing shorter: in the last half of a standstill they are as
  /// large as in the half before, and no larger than `rounding`, mm. The bound then stays what it is.
  bool stands_still(double rounding) const;

  /// Of steps that stand still: none but motions of this rate a step or slower can be left, so the bound is what such a
  /// one has still to go. Returns it, as value() does from now on, mm.
  double at_standstill(double slowest_rate);

  /// What was seen so far says nothing any more, as when the body has changed.
  void reset();

 private:
  /// Of the damping, in the last four windows or in as many as three times what the slowest motion in them lasts.
  double slowest_rate() const;

  /// How much larger A_0 was in the last four windows than it is now; 1 where that may be chance.
  double fall_of_eigenvalue() const;

  /// What is left of the largest in the last four windows, which all must be finite, or while a motion of this rate
  /// lasts.
  double largest_bound(double rate) const;

  /// Windows of half a standstill.
  std::ptrdiff_t half() const { return standstill / 2 / window_; }

  int window_;
  double margin_;
  std::vector<double> moved_, rates_, bounds_;
  std::ptrdiff_t loaded_ = 0;  // windows under the whole load
  double value_ = std::numeric_limits<double>::infinity();
};

}  // namespace brainshift::solve
