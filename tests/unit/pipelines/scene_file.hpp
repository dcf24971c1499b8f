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

namespace brainshift::pipelines {

/// A folder of its own for each test, with a scene in it.
class SceneFile : public testing::Test {
 protected:
  SceneFile() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() / ("brainshift_scene_" + std::string(info->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~SceneFile() override { std::filesystem::remove_all(folder_); }

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

  std::filesystem::path folder_;
};

inline void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
  }
}

}  // namespace brainshift::pipelines
