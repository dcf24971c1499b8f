// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/span_bound.hpp"

#include <algorithm>
#include <utility>

namespace brainshift::solve {

SpanBound::SpanBound(int window, double slowest)
    : windows_(static_cast<std::size_t>(windows_of(window))), slowest_(slowest) {}

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
  if (!is_known()) {
    return 0;
  }
  const NodalVectors &first = states_.front(), &middle = states_[windows_], &last = states_.back();
  double of_nodes = 0, longest = 0, both = 0, squares = 0;
  for (std::size_t a = 0; a < last.size() / 4; ++a) {
    const Eigen::Vector4d step = at(last, a) - at(middle, a), step_before = at(middle, a) - at(first, a);
    const double went = step.norm(), before = step_before.norm();
    of_nodes = std::max(of_nodes, of_node(went, before, slowest_));
    longest = std::max(longest, went);
    both += step.dot(step_before);
    squares += before * before;
  }
  return std::max(of_nodes, of_all(longest, both, squares));
}

double SpanBound::of_all(double longest, double product, double squares) {
  constexpr double slowest = 0.98, of_mixed_rates = 4.0 / 3;
  const double rate = squares > 0 ? std::clamp(product / squares, 0.0, slowest) : 0;
  return of_mixed_rates * still_to_go(rate) * longest;
}

}  // namespace brainshift::solve
