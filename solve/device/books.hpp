// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/view.hpp"

namespace brainshift::solve::device {

/// The work that was done and where it went, as Motion keeps these books, from the sums of each step; 1e-9 J.
struct Books {
  double external_work = 0, dissipated = 0;
  double largest_work = 0;  // mJ
  int looks_before = 0;     // until they count

  void add(const StepSums& sums, double alpha, double beta, double beta_before, double moved_on) {
    const double rate = sums.of[StepSums::multiplier_work] / alpha;
    external_work += moved_on * (rate + rate_before_) / 2 + force_work_before_;
    rate_before_ = rate;
    force_work_before_ = sums.of[StepSums::force_work];
    const double lost = (1 - beta) / (4 * alpha) * sums.of[StepSums::two_steps] - sums.of[StepSums::push_work] / alpha;
    dissipated += (lost_before_ + lost) / 2;
    lost_before_ = lost;
    dissipated += (beta_before - beta) / (4 * alpha) * sums.of[StepSums::step_before];
  }

 private:
  double rate_before_ = 0, force_work_before_ = 0, lost_before_ = 0;
};

}  // namespace brainshift::solve::device
