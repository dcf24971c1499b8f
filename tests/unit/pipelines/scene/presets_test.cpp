// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/presets.hpp"

#include <gtest/gtest.h>

namespace brainshift::pipelines::presets_test {

TEST(Presets, AreKnownByName) {
  EXPECT_TRUE(preset_overrides("").empty());
  EXPECT_NE(preset_overrides("fast"), preset_overrides("accurate"));
  EXPECT_THROW(preset_overrides("quick"), std::invalid_argument);
}

}  // namespace brainshift::pipelines::presets_test
