// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>

#include "segmentation/geometry/on_device.hpp"
#include "solve/arrays/nodal_vectors.hpp"

namespace brainshift::solve {

/// What is still to go, read off where all nodes were a span and two spans of steps ago. ErrorBound goes by what moved
/// most in single steps. Slow motions hide there behind quick ones: those of a few nodes, as beside the rim of what
/// touches the skull, and those of a whole body that hardly changes its volume. Over a span of eight steps or more
/// quick motions cancel.
class SpanBound {
 public:
  static constexpr double usual_rate = 0.9;  // at 0.95 the bound of the demo is 2.4 times its error

  /// How many windows of so many steps make a span.
  static constexpr int windows_of(int window) {
    constexpr int shortest_span = 8;  // steps
    return (shortest_span + window - 1) / window;
  }

  /// window: steps between two calls of add(). slowest: the largest q of a node.
  explicit SpanBound(int window, double slowest = usual_rate);

  /// now: u or û, mm; of as many nodes as before.
  void add(const NodalVectors& now);

  /// The larger of two, mm; 0 until two spans are known.
  /// Of a node that went d in the last span and d' in the one before: d q/(1 − q) with q = d/d', at most `slowest`, as
  /// nothing can be read off a node that hardly moves. Of all nodes: a third more than max d q/(1 − q) with q = Σ d·d'
  /// / Σ d'·d', at most 0.98. The third is for motions of several rates together, of which the slowest has more to go
  /// than their mean tells.
  double value() const;

  /// States at the begin and the end of the last span, once one is known.
  const NodalVectors& begin_of_last() const { return states_[states_.size() - 1 - windows_]; }
  const NodalVectors& end_of_last() const { return states_.back(); }

  /// Whether two spans are known.
  bool is_known() const { return states_.size() > 2 * windows_; }

  /// What was seen so far says nothing any more.
  void reset() { states_.clear(); }

  /// Of value(), what one node says that went so far in the last span, and in the one before, mm.
  BRAINSHIFT_ON_DEVICE static double of_node(double went, double before, double slowest = usual_rate) {
    return still_to_go(went < slowest * before ? went / before : slowest) * went;
  }
  /// What all nodes say together: the most that one went, Σ d·d', Σ d'·d'.
  static double of_all(double longest, double product, double squares);

 private:
  /// Σ rate^k, k from 1: of what was gone last, how much there is still to go.
  BRAINSHIFT_ON_DEVICE static double still_to_go(double rate) { return rate / (1 - rate); }

  std::size_t windows_;  // of a span
  double slowest_;
  std::deque<NodalVectors> states_;  // the latest last
};

}  // namespace brainshift::solve
