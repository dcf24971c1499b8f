// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace brainshift::solve {

/// How many threads are fastest while other programs take processors now and then: a thread that was put aside holds up
/// all that wait for it, which costs more than it helps where a step is short. Fewer are tried where something disturbs
/// the steps, more from time to time; whichever took less time stays, and a try that did not help waits twice as long
/// for the next.
class ThreadChoice {
 public:
  explicit ThreadChoice(int most) : most_(most), now_(most) {}

  /// Threads of the next steps. seconds: mean of a step on as many as were last returned; put_aside: how often, a step,
  /// one of them had to give way to another program.
  int next(double seconds, double put_aside);

 private:
  int to_try(bool disturbed);

  int most_;
  int now_;
  int tried_ = 0;       // 0: none is being tried
  double seconds_ = 0;  // of a step on now_
  double fastest_ = 0;  // on most_; 0: not known
  int patience_ = 2;    // windows between tries
  int rest_ = 0;        // windows to the next try
  bool fewer_ = true;   // the next try
};

/// Lets the loops of each step run on as many threads as ThreadChoice finds; when it ends, as many as before. Results
/// do not depend on it. Of a program that has one thread nothing is measured.
class StepThreads {
 public:
  StepThreads();
  ~StepThreads();
  StepThreads(const StepThreads&) = delete;
  StepThreads& operator=(const StepThreads&) = delete;

  void begin_step();
  void end_step();

 private:
  const int most_;
  ThreadChoice choice_;
  int steps_ = 0;  // of the window
  long put_aside_ = 0;
  std::chrono::steady_clock::time_point begin_;
  std::chrono::steady_clock::duration taken_{};
};

}  // namespace brainshift::solve
