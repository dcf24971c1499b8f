// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/commands/console.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>

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

// between two words of how far the work is
constexpr std::chrono::milliseconds on_terminal{100};
constexpr std::chrono::minutes in_file{1};

std::string percent(double fraction) {
  return std::to_string(static_cast<int>(std::floor(100 * fraction))) + " %";
}

}  // namespace

Console::Console(bool quiet, bool verbose) : quiet_(quiet), verbose_(verbose), terminal_(isatty(STDERR_FILENO) == 1) {}

Console::~Console() {
  clear();
}

void Console::clear() {
  if (on_line_) {
    std::fputs("\r\033[K", stderr);
    on_line_ = false;
  }
}

void Console::line(const std::string& text) {
  if (!quiet_) {
    clear();
    std::fprintf(stderr, "%s\n", printable(text).c_str());
  }
}

void Console::state(std::string_view name) {
  line("state " + std::string(name));
}

void Console::started(StageId stage) {
  last_what_.clear();
  if (!terminal_) {
    line(std::string(stage_name(stage)) + " ...");
    shown_ = Clock::now();
  }
}

void Console::progress(StageId stage, double fraction, double total, std::string_view what) {
  const auto now = Clock::now();
  if (start_fraction_ < 0) {
    start_fraction_ = total;
    begin_ = now;
  }
  const bool new_what = verbose_ && what != last_what_;
  last_what_ = what;
  if (new_what) {
    line(std::string(stage_name(stage)) + ": " + std::string(what));
  }
  if (quiet_ || now - shown_ < (terminal_ ? on_terminal : in_file)) {
    return;
  }
  shown_ = now;
  std::string text = std::string(stage_name(stage)) + " " + percent(fraction) + ", " + std::string(what);
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  const double done = total - start_fraction_;
  if (elapsed > 1 && done > 0.02) {
    text += ", about " + duration(std::ceil(elapsed * (1 - total) / done)) + " left";
  }
  if (!terminal_) {
    line(text);
    return;
  }
  std::fprintf(stderr, "\r\033[K%s", text.c_str());
  std::fflush(stderr);
  on_line_ = true;
}

void Console::finished(StageId stage, double seconds) {
  line(std::string(stage_name(stage)) + ": done in " + duration(seconds));
}

void Console::kept(StageId stage, std::string_view edited) {
  line(std::string(stage_name(stage)) + ": " +
       (edited.empty() ? "unchanged, kept" : "kept, with " + std::string(edited) + " as edited since"));
}

void Console::note(StageId stage, std::string_view sentence) {
  line(std::string(stage_name(stage)) + ": " + std::string(sentence));
}

void Console::failed(StageId stage) {
  line(std::string(stage_name(stage)) + ": did not converge");
}

}  // namespace brainshift::pipelines
