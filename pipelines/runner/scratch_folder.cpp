// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/scratch_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

#include "pipelines/runner/own_folder.hpp"

namespace brainshift::pipelines {
namespace {

namespace fs = std::filesystem;

const std::string beginning = "brainshift_scratch_";

void remove_abandoned(const fs::path& place) {
  std::error_code fault;
  for (fs::directory_iterator entry(place, fault), end; !fault && entry != end; entry.increment(fault)) {
    if (entry->path().filename().string().starts_with(beginning) && is_own_folder(entry->path())) {
      try {
        const FolderLock lock(entry->path());
        remove_own_folder(entry->path());
      } catch (const std::runtime_error&) {  // in use, or another user's
      }
    }
  }
}

}  // namespace

ScratchFolder::ScratchFolder(Interruption& interruption) : interruption_(interruption) {
  const fs::path place = fs::temp_directory_path();
  remove_abandoned(place);
  std::string name = (place / (beginning + "XXXXXX")).string();
  if (mkdtemp(name.data()) == nullptr) {
    throw std::runtime_error(place.string() + ": no folder can be made here; set TMPDIR to one that is writable");
  }
  path_ = name;
  lock_.emplace(path_);
  interruption_.set_scratch(path_);
  std::ofstream(path_ / unfinished_mark);
}

ScratchFolder::~ScratchFolder() {
  remove_own_folder(path_);
  interruption_.set_scratch({});
}

}  // namespace brainshift::pipelines
