// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/commands/console.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <system_error>

#include "pipelines/commands/printable.hpp"

namespace brainshift::pipelines {
namespace {

std::string duration(double seconds) {
  char text[32];
  if (seconds < 90) {
    std::snprintf(text, sizeof text, seconds < 10 ? "%.1f s" : "%.0f s", seconds);
  } else {
    std::snprintf(text, sizeof text, "%d min %d s", static_cast<int>(seconds) / 60, static_cast<int>(seconds) % 60);
  }
  return text;
}

constexpr std::chrono::milliseconds on_terminal{100};  // between two words of how far the work is

std::string percent(double fraction) {
  return std::to_string(static_cast<int>(std::floor(100 * fraction))) + " %";
}

}  // namespace

Console::Console(bool quiet, bool verbose, std::chrono::milliseconds every)
    : quiet_(quiet), verbose_(verbose), terminal_(isatty(STDERR_FILENO) == 1), every_(terminal_ ? on_terminal : every) {
  if (quiet_) {
    return;
  }
  try {
    clock_ = std::jthread([this](const std::stop_token& stop) { keep_showing(stop); });
  } catch (const std::system_error&) {  // a run is worth more than a word of how far it is
  }
}

Console::~Console() {
  clock_ = {};  // ends it
  clear();
}

void Console::keep_showing(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    end_.wait_for(lock, stop, std::min(every_, std::chrono::milliseconds{1000}), [] { return false; });
    if (work_ && Clock::now() - shown_ >= every_) {
      show();
    }
  }
}

void Console::show() {
  shown_ = Clock::now();
  const double seconds = work_->seconds();
  std::string text = std::string(stage_name(work_->stage)) + " " + percent(work_->fraction) +
                     (work_->what.empty() ? "" : ", " + work_->what) + ", " + duration(seconds) + " so far";
  if (const auto left = work_->left.at(seconds)) {
    text += ", about " + duration(std::ceil(*left)) + " left";
  }
  line(text, terminal_ ? "" : "\n");
  on_line_ = terminal_;
}

/// Over the line that is only meant to be seen for a while.
void Console::line(const std::string& text, const char* end) {
  if (!quiet_) {
    clear();
    std::fprintf(stderr, "%s%s", printable(text).c_str(), end);
    std::fflush(stderr);
  }
}

void Console::clear() {
  if (on_line_) {
    std::fputs("\r\033[K", stderr);
    on_line_ = false;
  }
}

void Console::state(std::string_view name) {
  const std::lock_guard lock(mutex_);
  line("state " + std::string(name));
}

void Console::started(StageId stage) {
  const std::lock_guard lock(mutex_);
  begin(stage);
  if (!terminal_) {
    line(std::string(stage_name(stage)) + " ...");
  }
}

void Console::progress(StageId stage, double fraction, std::string_view what) {
  const std::lock_guard lock(mutex_);
  if (!work_) {
    begin(stage);
  }
  if (verbose_ && what != work_->what) {
    line(std::string(stage_name(stage)) + ": " + std::string(what));
  }
  work_->fraction = fraction;
  work_->what = what;
  work_->left.note(fraction, work_->seconds());
}

void Console::begin(StageId stage) {
  work_ = Work{.stage = stage};
  shown_ = Clock::now();
}

void Console::end(StageId stage, const std::string& how) {
  const std::lock_guard lock(mutex_);
  work_.reset();
  line(std::string(stage_name(stage)) + ": " + how);
}

void Console::finished(StageId stage, double seconds) {
  end(stage, "done in " + duration(seconds));
}

void Console::failed(StageId stage) {
  end(stage, "did not converge");
}

void Console::kept(StageId stage, std::string_view edited) {
  end(stage, edited.empty() ? "unchanged, kept" : "kept, with " + std::string(edited) + " as edited since");
}

void Console::note(StageId stage, std::string_view sentence) {
  const std::lock_guard lock(mutex_);
  line(std::string(stage_name(stage)) + ": " + std::string(sentence));
}

}  // namespace brainshift::pipelines
