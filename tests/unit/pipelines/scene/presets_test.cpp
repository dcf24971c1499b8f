// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/presets.hpp"

#include <gtest/gtest.h>

#include "tests/unit/pipelines/scene_file.hpp"

namespace brainshift::pipelines::presets_test {

TEST(Presets, AreKnownByName) {
  EXPECT_TRUE(preset_overrides("").empty());
  EXPECT_NE(preset_overrides("fast"), preset_overrides("accurate"));
  EXPECT_THROW(preset_overrides("quick"), std::invalid_argument);
}

TEST(Presets, GiveWayToWhatIsGiven) {
  const std::vector<std::string> given = {"solve.tolerance=1", "solve.basis=modified_quadratic"};
  EXPECT_EQ(preset_overrides("", given), given);
  const std::vector<std::string> all = preset_overrides("fast", given);
  EXPECT_EQ(all.size(), preset_overrides("fast").size() + 2);
  EXPECT_EQ(all.back(), given.back());
}

/// A brain that only sinks has no opening to be finer at.
TEST_F(SceneFile, PresetsGoWithAndWithoutALoad) {
  write_image(folder_ / "labels.nii.gz", block_labels());
  write_load();
  const std::string body =
      "<image labels=\"labels.nii.gz\"/><tissues><tissue label=\"1\"/><tissue label=\"3\"/></tissues><contact/>";
  for (const char* acts :
       {"<load><craniotomy file=\"load.csv\"/></load>", "<gravity direction=\"0,1,0\" drained=\"30\"/>"}) {
    for (const char* preset : {"fast", "balanced", "accurate"}) {
      EXPECT_EQ(fault("<scene>" + body + acts + "</scene>", preset_overrides(preset)), "") << preset << acts;
    }
  }
}

}  // namespace brainshift::pipelines::presets_test
