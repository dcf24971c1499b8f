// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/stage_folder.hpp"

#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include "pipelines/checksum/sha256.hpp"
#include "pipelines/runner/own_folder.hpp"
#include "segmentation/files/make_folder.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/whole_path.hpp"

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

fs::path partial_of(const fs::path& place) {
  fs::path partial = place;
  partial += ".partial";
  refuse_foreign_folder(partial);
  return partial;
}

/// Old slices or steps among new ones would be taken for theirs.
void refuse_strangers(const fs::path& folder, const fs::path& taking_its_place) {
  if (!fs::is_directory(folder)) {
    return;
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!fs::exists(taking_its_place / entry.path().filename())) {
      refuse(folder, "holds a " + entry.path().filename().string() +
                         " that is not written anew; remove the folder, or choose another with --out");
    }
  }
}

}  // namespace

void refuse_to_replace(const fs::path& file) {
  refuse(file, "another file of that name lies here already; choose another folder, or move it away");
}

fs::path place_of(const fs::path& named) {
  if (named.empty()) {
    throw std::invalid_argument("the folder to write to has no name; give one with --out");
  }
  fs::path place = whole_path(named);
  place = place.has_filename() ? place : place.parent_path();  // a trailing slash
  std::error_code unknown;
  if (fs::exists(place, unknown) && !fs::is_directory(place, unknown)) {
    refuse(place, "this is a file; give --out a folder");
  }
  return place;
}

fs::path old_of(const fs::path& place) {
  fs::path old = place;
  old += ".old";
  return old;
}

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
    : place_(place_of(place)), partial_(partial_of(place_)), interruption_(interruption) {
  {
    const auto hold = interruption_.hold();  // who interrupts between the two would leave the folder
    lock_.emplace(partial_);
    interruption_.set_unfinished(partial_, hold);
  }
  clear_own_folder(partial_);  // of a run that was killed
  write_whole(partial_ / unfinished_mark, "");
}

StageFolder::~StageFolder() {
  if (!replaced_) {
    remove_own_folder(partial_);
  }
  interruption_.set_unfinished({});
}

void StageFolder::replace() {
  const auto hold = interruption_.hold();
  const fs::path old = old_of(place_);
  remove_own_folder(old);
  if (fs::exists(place_)) {
    move(place_, old);
  }
  std::error_code fault;
  fs::remove(partial_ / unfinished_mark, fault);
  move(partial_, place_);
  replaced_ = true;
  remove_own_folder(old);
}

void StageFolder::refuse_others_files() const {
  for (const auto& entry : fs::recursive_directory_iterator(partial_)) {
    const fs::path name = entry.path().lexically_relative(partial_), there = place_ / name;
    if (entry.is_regular_file() && fs::exists(there) &&
        (!fs::is_regular_file(there) || sha256_of_file(there) != sha256_of_file(entry.path()))) {
      refuse_to_replace(there);
    }
  }
}

void StageFolder::merge() {
  const auto hold = interruption_.hold();
  make_folder(place_);
  for (const auto& entry : fs::directory_iterator(partial_)) {
    if (entry.is_directory()) {
      refuse_strangers(place_ / entry.path().filename(), entry.path());
    }
  }
  for (const auto& entry : fs::directory_iterator(partial_)) {
    const fs::path there = place_ / entry.path().filename();
    if (entry.is_directory() && fs::is_directory(there)) {
      for (const auto& part : fs::directory_iterator(entry.path())) {
        move(part.path(), there / part.path().filename());
      }
    } else if (entry.path().filename() != unfinished_mark) {
      move(entry.path(), there);
    }
  }
}

}  // namespace brainshift::pipelines
