// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_timing.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace brainshift::solve {
namespace {

void check_number(const std::optional<double>& number, bool in_range, const char* what, const std::string& name) {
  if (number && !(std::isfinite(*number) && in_range)) {
    std::ostringstream text;
    text << name << ": the cut's " << what << ", found " << *number;
    throw std::invalid_argument(text.str());
  }
}

void check_timing(const CutTiming& timing, const std::string& name) {
  check_number(timing.start, timing.start.value_or(0) >= 0, "start must be a time of the load's curve, 0 or later",
               name);
  check_number(timing.speed, timing.speed.value_or(1) > 0, "speed must be above 0 mm in a unit of time", name);
  if (!timing.direction.allFinite()) {
    throw std::invalid_argument(name + ": the cut's direction must be three finite numbers");
  }
  if (!timing.direction.isZero(0) && !timing.speed) {
    throw std::invalid_argument(name + ": the cut has a direction but no speed; give the speed in it, or neither");
  }
}

}  // namespace

std::vector<double> times_along(const std::vector<double>& distance, const CutTiming& timing, const std::string& name) {
  check_timing(timing, name);
  const double start = timing.start.value_or(0);
  if (start == 0 && !timing.speed) {
    return {};
  }
  std::vector<double> times(distance.size(), start);
  if (timing.speed) {
    for (std::size_t i = 0; i < times.size(); ++i) {
      times[i] += distance[i] / *timing.speed;
    }
  }
  return times;
}

void refuse_timing(const CutTiming& timing, const std::string& name) {
  if (timing.start || timing.speed || !timing.direction.isZero(0)) {
    throw std::invalid_argument(name +
                                ": holds the times at which the cut gets to its vertices; leave start, speed and "
                                "direction out, or take the times out of the file");
  }
}

}  // namespace brainshift::solve
