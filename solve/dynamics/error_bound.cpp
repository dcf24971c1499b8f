// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/error_bound.hpp"

#include <algorithm>
#include <cmath>

namespace brainshift::solve {

namespace {

constexpr std::ptrdiff_t recent_windows = 4;  // that the bound looks back on at least

/// Steps in which a motion of this rate a step dies down to 1/e.
double lasting(double rate) {
  return rate < 1 ? 1 / (1 - rate) : std::numeric_limits<double>::infinity();
}

/// What is left of a critically damped motion after so many steps, at most 1.
double left_of_motion(double rate, double steps) {
  return rate < 1 ? (1 + steps * (1 - rate)) * std::pow(rate, steps) : 1;
}

double largest_recent(const std::vector<double>& values) {
  return *std::max_element(values.end() - recent_windows, values.end());
}

}  // namespace

double ErrorBound::slowest_rate() const {
  constexpr double memory = 3;
  double slowest = largest_recent(rates_);
  std::ptrdiff_t windows = recent_windows;
  while (windows < std::ssize(rates_) && static_cast<double>(windows * window_) < memory * lasting(slowest)) {
    ++windows;
    slowest = std::max(slowest, *(rates_.end() - windows));
  }
  return slowest;
}

double ErrorBound::fall_of_eigenvalue() const {
  constexpr double chance = 1.5;
  if (std::ssize(rates_) <= recent_windows || !(rates_.back() < 1)) {
    return 1;
  }
  const double quickest = *std::min_element(rates_.end() - 1 - recent_windows, rates_.end());
  const double fall = std::pow((1 - quickest) / (1 - rates_.back()), 2);  // √β is 1 − √(αA_0)
  return fall > chance ? fall : 1;
}

double ErrorBound::largest_bound(double rate) const {
  if (std::isinf(largest_recent(bounds_))) {
    return std::numeric_limits<double>::infinity();
  }
  const double most = static_cast<double>(bounds_.size());
  const double windows = std::clamp(std::ceil(lasting(rate) / window_), double{recent_windows}, most);
  double largest = 0;
  for (std::ptrdiff_t ago = 0; ago < static_cast<std::ptrdiff_t>(windows); ++ago) {
    const double bound = *(bounds_.end() - 1 - ago);
    if (std::isfinite(bound)) {
      largest = std::max(largest, bound * left_of_motion(rate, static_cast<double>(ago * window_)));
    }
  }
  return largest;
}

void ErrorBound::add(double moved, double damping_rate, bool loaded, double rounding, double slowest) {
  moved_.push_back(moved);
  rates_.push_back(damping_rate);
  bounds_.push_back(std::numeric_limits<double>::infinity());
  loaded_ = loaded ? loaded_ + 1 : 0;
  if (loaded_ > recent_windows) {  // a rate while the load comes is the load's
    const double earlier = *(moved_.end() - 1 - recent_windows);
    const double measured = moved > rounding ? std::pow(moved / earlier, 1.0 / (recent_windows * window_)) : 0.0;
    const double damped = slowest_rate(), rate = std::max({measured, damped, slowest});
    bounds_.back() = rate < 1 ? rate / (1 - rate) * moved : bounds_.back();
    value_ = fall_of_eigenvalue() * largest_bound(damped);
  }
}

double ErrorBound::with_spans(double of_spans, bool near_the_end) const {
  constexpr double more = 1.5;
  return margin_ * std::max(value_, (near_the_end ? 1 : more) * fall_of_eigenvalue() * of_spans);
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
  return value();
}

void ErrorBound::reset() {
  *this = ErrorBound(window_, margin_);
}

}  // namespace brainshift::solve
