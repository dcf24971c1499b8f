// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "pipelines/runner/interruption.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines {

namespace fs = std::filesystem;

/// A folder of its own for each test of what a run does with files.
class RunFolder : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    return scratch_.write(name, text);
  }
  static std::string read(const fs::path& file) { return brainshift::test::bytes_of(file); }

  brainshift::test::ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
  Interruption interruption_{[](int) {}};
};

}  // namespace brainshift::pipelines
