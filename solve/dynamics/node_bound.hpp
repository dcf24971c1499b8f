// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>

#include "solve/arrays/nodal_vectors.hpp"

namespace brainshift::solve {

/// What single nodes have still to go. ErrorBound goes by what moves most: where a few nodes slide slowly, as beside
/// the rim of what touches the skull, it does not see them before all others are at rest. Of a node that went d in the
/// last span and d' in the one before: d q/(1 − q) with q = d/d', at most 0.9, as nothing can be read off a node that
/// hardly moves. Over a span of eight steps or more fast motions cancel.
class NodeBound {
 public:
  /// window: steps between two calls of add().
  explicit NodeBound(int window);

  /// now: û, mm; of as many nodes as before.
  void add(const NodalVectors& now);

  /// The largest of all nodes, mm; 0 until two spans are known.
  double value() const;

  /// What was seen so far says nothing any more.
  void reset() { states_.clear(); }

 private:
  std::size_t windows_;              // of a span
  std::deque<NodalVectors> states_;  // the latest last
};

}  // namespace brainshift::solve
