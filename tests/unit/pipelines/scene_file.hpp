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
#include "segmentation/image/image.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines {

using test::expect_parts;

/// A folder of its own for each test, with a scene in it.
class SceneFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    std::ofstream(folder_ / "scene.xml") << text;
    return folder_ / "scene.xml";
  }
  std::filesystem::path write_load() const {
    std::ofstream(folder_ / "load.csv") << "# frame: LPS\nx,y,z,ux,uy,uz\n1,1,1,0,0,-1\n";
    return folder_ / "load.csv";
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

inline LabelMap block_labels() {
  LabelMap map;
  map.geometry.size = {4, 4, 4};
  map.voxels.assign(64, 0);
  map.at(1, 1, 1) = 1;
  map.at(2, 1, 1) = 3;
  map.at(1, 2, 1) = 6;
  return map;
}

}  // namespace brainshift::pipelines
