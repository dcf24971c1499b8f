// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_timing.hpp"

#include <stdexcept>

namespace brainshift::solve {
namespace {

void check_timing(const CutTiming& timing, const std::string& name) {
  for (const Option<CutTiming>& option : cut_timing_options()) {
    if (!option.holds(timing)) {
      throw std::invalid_argument(name + ": the cut's " + refusal(option, option.get(timing)));
    }
  }
  if (!timing.direction.isZero(0) && !timing.speed) {
    throw std::invalid_argument(name + ": the cut has a direction but no speed; give the speed in it, or neither");
  }
}

}  // namespace

const OptionTable<CutTiming>& cut_timing_options() {
  static const OptionTable<CutTiming> table = {
      number_option<CutTiming>("start", &CutTiming::start, not_negative, "time of the load's curve",
                               "when it begins; without it and a speed the body is cut from the start"),
      number_option<CutTiming>("speed", &CutTiming::speed, above_zero, "mm in a unit of that time",
                               "at which it goes on; without it the whole cut is there at its start"),
      vector_option<CutTiming>("direction", &CutTiming::direction, "any length",
                               "in which a sheet is cut at that speed; 0 0 0: none")};
  return table;
}

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
