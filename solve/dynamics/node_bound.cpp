// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/node_bound.hpp"

#include <algorithm>
#include <utility>

namespace brainshift::solve {

namespace {

constexpr int shortest_span = 8;  // steps
constexpr double slowest = 0.9;   // q; at 0.95 the bound of the demo is 2.4 times its error

}  // namespace

NodeBound::NodeBound(int window) : windows_(static_cast<std::size_t>((shortest_span + window - 1) / window)) {}

void NodeBound::add(const NodalVectors& now) {
  NodalVectors state;
  if (states_.size() > 2 * windows_) {
    state = std::move(states_.front());  // its memory goes on in use
    states_.pop_front();
  }
  state = now;
  states_.push_back(std::move(state));
}

double NodeBound::value() const {
  if (states_.size() <= 2 * windows_) {
    return 0;
  }
  const NodalVectors &first = states_.front(), &middle = states_[windows_], &last = states_.back();
  double largest = 0;
  for (std::size_t a = 0; a < last.size() / 4; ++a) {
    const double went = (at(last, a) - at(middle, a)).norm(), before = (at(middle, a) - at(first, a)).norm();
    const double ratio = went < slowest * before ? went / before : slowest;
    largest = std::max(largest, ratio / (1 - ratio) * went);
  }
  return largest;
}

}  // namespace brainshift::solve
