// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/interruption.hpp"

#include <csignal>
#include <ctime>
#include <utility>

#include "pipelines/runner/own_folder.hpp"

namespace brainshift::pipelines {
namespace {

sigset_t watched_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) {  // as nohup sets it
      sigaddset(&signals, signal);
    }
  }
  return signals;
}

}  // namespace

Interruption::Interruption(std::function<void(int)> farewell) : farewell_(std::move(farewell)) {
  const sigset_t signals = watched_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  watcher_ = std::thread([this] { watch(); });
}

Interruption::~Interruption() {
  if (!watcher_.joinable()) {
    return;
  }
  stop_ = true;
  watcher_.join();
  const sigset_t signals = watched_signals();
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

void Interruption::set_unfinished(const std::filesystem::path& folder) {
  set_unfinished(folder, hold());
}

void Interruption::set_unfinished(const std::filesystem::path& folder, const std::unique_lock<std::mutex>&) {
  unfinished_ = folder;
}

void Interruption::set_scratch(const std::filesystem::path& folder) {
  const std::lock_guard lock(mutex_);
  scratch_ = folder;
}

void Interruption::set_command(pid_t group) {
  const std::lock_guard lock(mutex_);
  command_ = group;
}

void Interruption::watch() {
  const sigset_t signals = watched_signals();
  const timespec patience{.tv_sec = 0, .tv_nsec = 50'000'000};
  while (!stop_) {
    const int signal = sigtimedwait(&signals, nullptr, &patience);
    if (signal > 0) {
      clean_up();
      farewell_(signal);
    }
  }
}

void Interruption::clean_up() {
  // The lock is kept: the main thread must not begin another folder, nor rename this one, until the program ends.
  mutex_.lock();
  if (command_ != 0) {
    kill(-command_, SIGTERM);
  }
  // The main thread may still be writing: a file that it has just made can keep the folder from going.
  std::error_code fault;
  for (const std::filesystem::path& folder : {unfinished_, scratch_}) {
    for (int attempt = 0; attempt < 100 && !folder.empty(); ++attempt) {
      remove_own_folder(folder);
      if (!std::filesystem::exists(folder, fault)) {
        break;
      }
    }
  }
}

}  // namespace brainshift::pipelines
