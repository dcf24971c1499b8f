// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/artefacts.hpp"

#include <gtest/gtest.h>

#include "pipelines/checksum/sha256.hpp"
#include "segmentation/files/surface_file.hpp"
#include "tests/unit/pipelines/run_folder.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::pipelines::artefacts_test {

class ArtefactsTest : public RunFolder {
 protected:
  void SetUp() override {
    write("steps/1.csv", "1");
    write("load.csv", "22");
    write("stage.json", "{}");
    write(".unfinished", "");
    write_surface(folder_ / "brain.vtp", brainshift::test::sphere({0, 0, 0}, 20, 1));
    recorded_ = artefacts_in(folder_);
  }
  ArtefactChanges changes() const { return changes_of(recorded_, folder_); }

  nlohmann::ordered_json recorded_;
};

TEST_F(ArtefactsTest, AreAllFilesButTheMarks) {
  ASSERT_EQ(recorded_.size(), 3U);
  EXPECT_EQ(recorded_["load.csv"]["bytes"], 2);
  EXPECT_EQ(recorded_["steps/1.csv"]["sha256"], sha256_of_text("1"));
  EXPECT_TRUE(changes().lost.empty() && changes().edited.empty());
  write("mine", "a file that the user put there");
  EXPECT_TRUE(changes().lost.empty());
}

TEST_F(ArtefactsTest, ThatAreGoneEmptyOrDamagedAreLost) {
  const std::string surface = read(folder_ / "brain.vtp");
  write("brain.vtp", surface.substr(0, surface.size() / 2));
  EXPECT_EQ(changes().lost, "brain.vtp");
  write("brain.vtp", surface);
  write("load.csv", "");
  EXPECT_EQ(changes().lost, "load.csv");
  write("load.csv", "23");
  EXPECT_EQ(changes().lost, "load.csv") << "of the same length";
  write("load.csv", "22");
  fs::remove(folder_ / "steps/1.csv");
  EXPECT_EQ(changes().lost, "steps/1.csv");
}

TEST_F(ArtefactsTest, ASurfaceThatWasReplacedByAnotherIsEdited) {
  write_surface(folder_ / "brain.vtp", brainshift::test::sphere({1, 0, 0}, 21, 1));
  EXPECT_EQ(changes().lost, "");
  EXPECT_EQ(changes().edited, std::vector<std::string>{"brain.vtp"});
}

}  // namespace brainshift::pipelines::artefacts_test
