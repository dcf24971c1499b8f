// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/step_threads.hpp"

#include <omp.h>
#include <sys/resource.h>

#include <algorithm>

namespace brainshift::solve {

namespace {

constexpr int window = 12;  // steps
constexpr double often_put_aside = 0.3;
constexpr double slower = 1.2, faster = 0.95;               // than before; less is chance
constexpr int patience_after_help = 8, most_patience = 64;  // windows

/// How often threads of the process had to give way so far.
long times_put_aside() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_nivcsw;
}

}  // namespace

int ThreadChoice::next(double seconds, double put_aside) {
  if (tried_ > 0) {
    const bool helps = seconds < faster * seconds_;
    now_ = helps ? tried_ : now_;
    patience_ = helps ? patience_after_help : std::min(2 * patience_, most_patience);
    rest_ = patience_;
    tried_ = 0;
    return now_;
  }
  seconds_ = seconds;
  if (now_ == most_) {
    fastest_ = fastest_ > 0 ? std::min(fastest_, seconds) : seconds;
  }
  if (--rest_ > 0) {
    return now_;
  }
  tried_ = to_try(put_aside > often_put_aside || (now_ == most_ && seconds > slower * fastest_));
  return tried_ > 0 ? tried_ : now_;
}

/// 0: none.
int ThreadChoice::to_try(bool disturbed) {
  if (now_ == most_) {
    return disturbed && now_ > 1 ? 3 * now_ / 4 : 0;
  }
  fewer_ = !fewer_ && disturbed && now_ > 1;
  return fewer_ ? 3 * now_ / 4 : std::min(most_, now_ + std::max(1, now_ / 3));
}

StepThreads::StepThreads() : most_(omp_get_max_threads()), choice_(most_), put_aside_(times_put_aside()) {}

StepThreads::~StepThreads() {
  omp_set_num_threads(most_);
}

void StepThreads::begin_step() {
  if (most_ > 1) {
    begin_ = std::chrono::steady_clock::now();
  }
}

void StepThreads::end_step() {
  if (most_ == 1) {
    return;
  }
  taken_ += std::chrono::steady_clock::now() - begin_;
  if (++steps_ < window) {
    return;
  }
  const long put_aside = times_put_aside();
  const double seconds = std::chrono::duration<double>(taken_).count() / window;
  omp_set_num_threads(choice_.next(seconds, static_cast<double>(put_aside - put_aside_) / window));
  put_aside_ = put_aside;
  steps_ = 0;
  taken_ = {};
}

}  // namespace brainshift::solve
