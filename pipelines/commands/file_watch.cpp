// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/commands/file_watch.hpp"

#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <utility>

namespace brainshift::pipelines {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds pause{5};  // between looks at the file, unless its folder tells of a change
constexpr std::chrono::milliseconds rest{20};  // unchanged for so long, it is whole

FileState state_of(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) {
    return {};
  }
  return {true, status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

}  // namespace

FileWatch::FileWatch(fs::path file)
    : file_(fs::absolute(std::move(file))), events_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
  if (events_ >= 0 && inotify_add_watch(events_, file_.parent_path().c_str(),
                                        IN_CREATE | IN_MODIFY | IN_CLOSE_WRITE | IN_MOVED_TO) < 0) {
    close(events_);
    events_ = -1;
  }
}

FileWatch::~FileWatch() {
  if (events_ >= 0) {
    close(events_);
  }
}

FileState FileWatch::next() {
  for (;; wait()) {
    const FileState now = state_of(file_);
    closed_ = closed_ && now != returned_;  // else the event tells of what is known
    if (now != seen_) {
      seen_ = now;
      since_ = Clock::now();
    }
    if (now.there && now != returned_ && (closed_ || Clock::now() - since_ >= rest)) {
      returned_ = now;
      return now;
    }
  }
}

void FileWatch::wait() {
  pollfd change{events_, POLLIN, 0};  // a negative descriptor only waits
  poll(&change, 1, static_cast<int>(pause.count()));
  alignas(inotify_event) char buffer[4096];
  ssize_t length = 0;
  while ((length = read(events_, buffer, sizeof buffer)) > 0) {
    for (ssize_t at = 0; at < length;) {
      const auto& event = *reinterpret_cast<const inotify_event*>(buffer + at);
      if (event.len > 0 && file_.filename() == event.name) {
        closed_ = (event.mask & (IN_CLOSE_WRITE | IN_MOVED_TO)) != 0;
      }
      at += static_cast<ssize_t>(sizeof event + event.len);
    }
  }
}

}  // namespace brainshift::pipelines
