// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace brainshift::bench {

/// When the solver reported its steps, by a clock of the caller's.
class StepTimes {
 public:
  /// A report of progress, at `now` s; those that are of no step are left aside.
  void note(std::string_view what, double now) {
    constexpr std::string_view step = "step ";
    if (what.starts_with(step)) {
      reports_.emplace_back(std::atoi(std::string(what.substr(step.size())).c_str()), now);
    }
  }
  /// Seconds a step, between one report and the next.
  std::vector<double> seconds() const {
    std::vector<double> seconds;
    for (std::size_t i = 1; i < reports_.size(); ++i) {
      if (const int steps = reports_[i].first - reports_[i - 1].first; steps > 0) {
        seconds.push_back((reports_[i].second - reports_[i - 1].second) / steps);
      }
    }
    return seconds;
  }

 private:
  std::vector<std::pair<int, double>> reports_;
};

}  // namespace brainshift::bench
