// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/span_bound.hpp"

#include <algorithm>
#include <utility>

namespace brainshift::solve {

namespace {

constexpr int shortest_span = 8;      // steps
constexpr double slowest_node = 0.9;  // q; at 0.95 the bound of the demo is 2.4 times its error
constexpr double slowest_body = 0.98;
constexpr double of_mixed_rates = 4.0 / 3;

/// Σ rate^k, k from 1: of what was gone last, how much there is still to go.
double still_to_go(double rate) {
  return rate / (1 - rate);
}

}  // namespace

SpanBound::SpanBound(int window) : windows_(static_cast<std::size_t>((shortest_span + window - 1) / window)) {}

void SpanBound::add(const NodalVectors& now) {
  NodalVectors state;
  if (states_.size() > 2 * windows_) {
    state = std::move(states_.front());  // its memory goes on in use
    states_.pop_front();
  }
  state = now;
  states_.push_back(std::move(state));
}

double SpanBound::value() const {
  if (states_.size() <= 2 * windows_) {
    return 0;
  }
  const NodalVectors &first = states_.front(), &middle = states_[windows_], &last = states_.back();
  double of_nodes = 0, longest = 0, both = 0, squares = 0;
  for (std::size_t a = 0; a < last.size() / 4; ++a) {
    const Eigen::Vector4d step = at(last, a) - at(middle, a), step_before = at(middle, a) - at(first, a);
    const double went = step.norm(), before = step_before.norm();
    of_nodes = std::max(of_nodes, still_to_go(went < slowest_node * before ? went / before : slowest_node) * went);
    longest = std::max(longest, went);
    both += step.dot(step_before);
    squares += before * before;
  }
  const double rate = squares > 0 ? std::clamp(both / squares, 0.0, slowest_body) : 0;
  return std::max(of_nodes, of_mixed_rates * still_to_go(rate) * longest);
}

}  // namespace brainshift::solve
