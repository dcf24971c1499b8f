// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/commands/file_watch.hpp"

#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <utility>

#include "segmentation/files/readable_file.hpp"
#include "segmentation/files/refuse.hpp"

namespace brainshift::pipelines {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds pause{5};        // between looks at the file, unless its folder tells of a change
constexpr std::chrono::milliseconds rest{20};        // unchanged for so long, it is whole if nothing tells of a writer
constexpr std::chrono::milliseconds patience{2000};  // the same with a writer, and before it counts as half-written

FileState state_of(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) {
    return {};
  }
  const timespec &contents = status.st_mtim, &inode = status.st_ctim;
  return {true,
          S_ISREG(status.st_mode),
          status.st_ino,
          status.st_size,
          {contents.tv_sec, contents.tv_nsec, inode.tv_sec, inode.tv_nsec}};
}

/// Again and again: the folder may come later, or another in its place.
void watch_folder(int events, const fs::path& folder) {
  inotify_add_watch(events, folder.c_str(), IN_CREATE | IN_MODIFY | IN_CLOSE_WRITE | IN_MOVED_TO);
}

/// Also where it cannot be read.
bool ends_with_newline(const fs::path& file) {
  std::ifstream text(file, std::ios::binary);
  if (!text) {
    return true;
  }
  text.seekg(-1, std::ios::end);
  return text.get() == '\n';
}

}  // namespace

std::string want_of_newline(const fs::path& file) {
  return ends_with_newline(file)
             ? ""
             : file.string() + ": the last line has no line end; if the file was still being written, give it again";
}

FileWatch::FileWatch(fs::path file)
    : file_(fs::absolute(std::move(file))), events_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
  watch_folder(events_, file_.parent_path());
}

FileWatch::~FileWatch() {
  if (events_ >= 0) {
    close(events_);
  }
}

FileState FileWatch::next() {
  for (;; wait()) {
    const FileState now = state_of(file_);
    if (now != seen_) {
      seen_ = now;
      since_ = Clock::now();
    }
    if (!now.there || now == returned_) {
      told_ = Told::nothing;  // nothing new
    } else if (!now.regular) {
      if (std::exchange(refused_, now) != now) {
        check_readable(file_);
      }
    } else if (is_whole()) {
      told_ = Told::nothing;
      returned_ = now;
      return now;
    } else if (now != refused_ && Clock::now() - since_ >= patience) {
      refused_ = now;
      refuse(file_, "half-written: it has no newline at its end and was not seen to be closed; end its last line");
    }
  }
}

/// What was refused becomes so when it is closed as it is.
bool FileWatch::is_whole() const {
  if (told_ == Told::closed) {
    return true;
  }
  const Clock::duration rested = Clock::now() - since_;
  return seen_ != refused_ && rested >= (told_ == Told::written ? patience : rest) && ends_with_newline(file_);
}

void FileWatch::wait() {
  watch_folder(events_, file_.parent_path());
  pollfd change{events_, POLLIN, 0};  // a negative descriptor only waits
  poll(&change, 1, static_cast<int>(pause.count()));
  alignas(inotify_event) char buffer[4096];
  ssize_t length = 0;
  while ((length = read(events_, buffer, sizeof buffer)) > 0) {
    for (ssize_t at = 0; at < length;) {
      const auto& event = *reinterpret_cast<const inotify_event*>(buffer + at);
      if (event.len > 0 && file_.filename() == event.name) {
        told_ = (event.mask & (IN_CLOSE_WRITE | IN_MOVED_TO)) != 0 ? Told::closed : Told::written;
      }
      at += static_cast<ssize_t>(sizeof event + event.len);
    }
  }
}

}  // namespace brainshift::pipelines
