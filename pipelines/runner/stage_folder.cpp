// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/stage_folder.hpp"

#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include "segmentation/files/make_folder.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& file, const std::string& what, const std::error_code& fault) {
  throw std::runtime_error(file.string() + ": cannot be " + what + " (" + fault.message() +
                           "); check the disk and your rights, or choose another folder with --out");
}

void move(const fs::path& from, const fs::path& to) {
  std::error_code fault;
  fs::rename(from, to, fault);
  if (fault) {
    fail(to, "written", fault);
  }
}

}  // namespace

void write_whole(const fs::path& file, const std::string& text) {
  fs::path unfinished = file;
  unfinished += ".partial";
  std::ofstream stream(unfinished, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    const std::error_code fault(errno, std::generic_category());
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    fail(file, "written", fault);
  }
  move(unfinished, file);
}

StageFolder::StageFolder(const fs::path& place, Interruption& interruption)
    : place_(fs::absolute(place).lexically_normal()), interruption_(interruption) {
  if (!place_.has_filename()) {  // a trailing slash
    place_ = place_.parent_path();
  }
  partial_ = place_;
  partial_ += ".partial";
  make_folder(place_.parent_path());
  std::error_code fault;
  fs::remove_all(partial_, fault);  // of a run that was killed
  interruption_.set_unfinished(partial_);
  make_folder(partial_);
}

StageFolder::~StageFolder() {
  std::error_code fault;
  fs::remove_all(partial_, fault);
  interruption_.set_unfinished({});
}

void StageFolder::replace() {
  const auto hold = interruption_.hold();
  fs::path old = place_;
  old += ".old";
  std::error_code fault;
  fs::remove_all(old, fault);
  if (fs::exists(place_)) {
    move(place_, old);
  }
  move(partial_, place_);
  fs::remove_all(old, fault);
}

void StageFolder::merge() {
  const auto hold = interruption_.hold();
  make_folder(place_);
  for (const auto& entry : fs::directory_iterator(partial_)) {
    move(entry.path(), place_ / entry.path().filename());
  }
}

}  // namespace brainshift::pipelines
