// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>

namespace brainshift::pipelines {

/// Leaves nothing half-written when the user interrupts (SIGINT, SIGTERM, SIGHUP, SIGQUIT) or the time that a limit
/// allows is over (SIGXCPU): the signals are taken by a thread of its own, which ends the external command that runs,
/// removes the unfinished folder and calls `farewell`, which is to end the program. Make it before any other thread,
/// and once.
class Interruption {
 public:
  /// Takes no signal: for a program that has its own way, an interpreter, which interrupts by an exception.
  Interruption() = default;
  explicit Interruption(std::function<void(int signal)> farewell);
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// The folder that is being written; empty for none. The second is for who holds already.
  void set_unfinished(const std::filesystem::path& folder);
  void set_unfinished(const std::filesystem::path& folder, const std::unique_lock<std::mutex>& hold);
  /// A folder that goes whole when the program is interrupted; empty for none.
  void set_scratch(const std::filesystem::path& folder);
  /// While this lives nobody is interrupted: for a few renames that belong together.
  [[nodiscard]] std::unique_lock<std::mutex> hold() { return std::unique_lock(mutex_); }
  /// The external command's process group; 0 for none.
  void set_command(pid_t group);

 private:
  void watch();
  void clean_up();

  std::function<void(int)> farewell_;
  std::mutex mutex_;
  std::filesystem::path unfinished_, scratch_;
  pid_t command_ = 0;
  std::atomic<bool> stop_ = false;
  std::thread watcher_;
};

}  // namespace brainshift::pipelines
