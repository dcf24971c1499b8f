// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "pipelines/commands/time_left.hpp"
#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// Shows how far a stage is and how long it still takes, on standard error: one line that is written over on a
/// terminal; otherwise plain lines, of a long stage each minute, also while it has nothing new to say; nothing when
/// quiet.
class Console {
 public:
  /// every: between two plain lines of a stage.
  Console(bool quiet, bool verbose, std::chrono::milliseconds every = std::chrono::minutes{1});
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void state(std::string_view name);
  void started(StageId stage);
  /// fraction: of the stage. A stage that was not started is so by that.
  void progress(StageId stage, double fraction, std::string_view what);
  void finished(StageId stage, double seconds);
  /// edited: names of files, or empty.
  void kept(StageId stage, std::string_view edited);
  void failed(StageId stage);
  void note(StageId stage, std::string_view sentence);

 private:
  using Clock = std::chrono::steady_clock;
  /// The stage that is being made.
  struct Work {
    StageId stage;
    Clock::time_point begin = Clock::now();
    double fraction = 0;
    std::string what = {};
    TimeLeft left = {};

    double seconds() const { return std::chrono::duration<double>(Clock::now() - begin).count(); }
  };

  void keep_showing(const std::stop_token& stop);
  void show();
  void begin(StageId stage);
  void end(StageId stage, const std::string& how);
  void line(const std::string& text, const char* end = "\n");
  void clear();

  const bool quiet_, verbose_, terminal_;
  const std::chrono::milliseconds every_;
  std::mutex mutex_;  ///< of what follows: the clock shows while the work goes on
  std::optional<Work> work_;
  bool on_line_ = false;
  Clock::time_point shown_{};
  std::condition_variable_any end_;
  std::jthread clock_;
};

}  // namespace brainshift::pipelines
