// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

namespace brainshift::pipelines {

/// How long a stage still takes, from how fast its fraction has grown since that last began to grow: what was prepared
/// before tells nothing of it, and a second try starts anew.
class TimeLeft {
 public:
  /// seconds: since any moment, the same in all calls.
  void note(double fraction, double seconds) {
    if (fraction < fraction_ || fraction_ == 0) {
      begin_fraction_ = fraction;
      begin_ = seconds;
    }
    fraction_ = fraction;
    last_ = seconds;
  }

  /// Seconds from now on; nothing while too little is known.
  std::optional<double> at(double seconds) const {
    const double done = fraction_ - begin_fraction_, taken = last_ - begin_;
    if (taken < shortest || done < least) {
      return std::nullopt;
    }
    const double left = taken * (1 - fraction_) / done - (seconds - last_);
    return left > 0 ? std::optional(left) : std::nullopt;
  }

 private:
  static constexpr double shortest = 1, least = 0.02;  // s; of the stage
  double fraction_ = 0, begin_fraction_ = 0;
  double begin_ = 0, last_ = 0;
};

}  // namespace brainshift::pipelines
