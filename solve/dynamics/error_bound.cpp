// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/error_bound.hpp"

#include <algorithm>
#include <cmath>

namespace brainshift::solve {

namespace {

constexpr int recent_windows = 4;  // that the bound looks back on

double largest_recent(const std::vector<double>& values) {
  return *std::max_element(values.end() - recent_windows, values.end());
}

}  // namespace

void ErrorBound::add(double moved, double damping_rate, bool loaded, double rounding) {
  moved_.push_back(moved);
  rates_.push_back(damping_rate);
  bounds_.push_back(std::numeric_limits<double>::infinity());
  loaded_ = loaded ? loaded_ + 1 : 0;
  if (loaded_ > recent_windows) {  // a rate while the load comes is the load's
    const double earlier = *(moved_.end() - 1 - recent_windows);
    const double measured = moved > rounding ? std::pow(moved / earlier, 1.0 / (recent_windows * window_)) : 0.0;
    const double rate = std::max(measured, largest_recent(rates_));
    bounds_.back() = rate < 1 ? rate / (1 - rate) * moved : bounds_.back();
    value_ = largest_recent(bounds_);
  }
}

bool ErrorBound::stands_still(double rounding) const {
  constexpr double even = 0.9;
  if (loaded_ < 2 * half()) {
    return false;
  }
  const double now = *std::max_element(moved_.end() - half(), moved_.end());
  const double before = *std::max_element(moved_.end() - 2 * half(), moved_.end() - half());
  return now <= rounding && now >= even * before && before >= even * now;
}

double ErrorBound::at_standstill(double slowest_rate) {
  value_ = slowest_rate / (1 - slowest_rate) * *std::max_element(moved_.end() - half(), moved_.end());
  return value_;
}

void ErrorBound::reset() {
  *this = ErrorBound(window_);
}

}  // namespace brainshift::solve
