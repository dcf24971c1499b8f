// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// Shows how far the work is, on standard error: one line that is written over on a terminal, with an estimate of the
/// time left; otherwise plain lines, of a long stage each minute; nothing when quiet.
class Console {
 public:
  Console(bool quiet, bool verbose);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void state(std::string_view name);
  void started(StageId stage);
  /// total: fraction of the whole work that is done, for the estimate.
  void progress(StageId stage, double fraction, double total, std::string_view what);
  void finished(StageId stage, double seconds);
  /// edited: names of files, or empty.
  void kept(StageId stage, std::string_view edited);
  void failed(StageId stage);
  void note(StageId stage, std::string_view sentence);

 private:
  using Clock = std::chrono::steady_clock;
  void line(const std::string& text);
  void clear();

  bool quiet_;
  bool verbose_;
  bool terminal_;
  bool on_line_ = false;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point shown_{};
  double start_fraction_ = -1;  ///< of the whole, when work began: what was kept took no time
  std::string last_what_;
};

}  // namespace brainshift::pipelines
