// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipelines/scene/check_scene.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines {

/// A folder of its own for each test, with a scene in it.
class SceneFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    std::ofstream(folder_ / "scene.xml") << text;
    return folder_ / "scene.xml";
  }
  std::filesystem::path touch(const std::string& name) const {
    std::ofstream(folder_ / name) << "x";
    return folder_ / name;
  }
  Scene parse(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return parse_scene(write(text), overrides);
  }
  /// The message of the fault in a scene; empty when there is none.
  std::string fault(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    try {
      check_scene(parse(text, overrides));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  }

  brainshift::test::ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_.path();
};

inline void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
  }
}

}  // namespace brainshift::pipelines
