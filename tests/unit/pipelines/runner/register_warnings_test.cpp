// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/register_warnings.hpp"

#include <gtest/gtest.h>

#include "tests/unit/pipelines/runner/expect_one.hpp"

namespace brainshift::pipelines::register_warnings_test {

TEST(RegisterWarnings, TellOfAFieldThatFolds) {
  registration::RegisterMeasures measures;
  EXPECT_TRUE(warnings_of(measures).empty());
  measures.folded_voxels = 768;
  measures.field_jacobian_min = -0.16;
  expect_one(warnings_of(measures), {"768 voxels", "-0.16"});
}

TEST(RegisterWarnings, TellWhereNoNodesAreNear) {
  registration::RegisterMeasures measures;
  measures.brain_voxels = 1000000;
  measures.without_nodes = 8;
  EXPECT_TRUE(warnings_of(measures).empty()) << "a gap in another program's cloud";
  measures.without_nodes = 4000;
  const Warnings warnings = warnings_of(measures);
  expect_one(warnings, {"4000 voxels", "--wall"});
}

}  // namespace brainshift::pipelines::register_warnings_test
