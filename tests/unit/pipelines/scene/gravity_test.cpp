// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/gravity.hpp"

#include <gtest/gtest.h>

#include "tests/unit/pipelines/scene_file.hpp"

namespace brainshift::pipelines::gravity_test {

Points column() {
  Points nodes(2, 3);
  nodes << 10, -70, 0, 20, 130, 40;
  return nodes;
}

TEST(DrainedFluidOfAScene, TakesTheLevelInAnyOfItsThreeForms) {
  Gravity gravity{.direction = {0, 3, 0}};
  gravity.drained = 25;
  const solve::DrainedFluid fluid = drained_fluid(gravity, column());
  EXPECT_DOUBLE_EQ(fluid.level, -20) << "a quarter of 200 mm below the top";
  EXPECT_NEAR((fluid.gravity - Eigen::Vector3d(0, 9.80665, 0)).norm(), 0, 1e-12) << "whatever the direction's length";
  EXPECT_EQ(fluid.gravity, fluid.gravity_of_image);
  gravity.drained.reset();
  gravity.fluid_point = Eigen::Vector3d(99, -5, 7);
  EXPECT_DOUBLE_EQ(drained_fluid(gravity, column()).level, -5);
  gravity.fluid_point.reset();
  gravity.fluid_level = 12;
  gravity.image_direction = Eigen::Vector3d(0, 0, -1);
  EXPECT_DOUBLE_EQ(drained_fluid(gravity, column()).level, 12);
  EXPECT_LT(drained_fluid(gravity, column()).gravity_of_image.z(), -9.8);
  gravity.fluid_density = 850;
  EXPECT_EQ(drained_fluid(gravity, column()).density, 850);
}

TEST_F(SceneFile, GravityIsHeldByTheSkullOrALoad) {
  write_image(folder_ / "labels.nii.gz", block_labels());
  write_load();
  const std::string body =
      "<image labels=\"labels.nii.gz\"/><tissues><tissue label=\"1\"/><tissue label=\"3\" "
      "swelling=\"0.1\" room=\"full\"/></tissues>";
  const auto scene = [&](const std::string& more) { return "<scene>\n" + body + more + "\n</scene>"; };
  const std::string load = "<load><craniotomy file=\"load.csv\"/></load>";
  const std::string drained = "<gravity direction=\"0,1,0\" drained=\"30\"/>";
  EXPECT_EQ(fault(scene(drained + "<contact/>")), "");
  EXPECT_EQ(fault(scene(drained + load)), "");
  expect_parts(fault(scene(drained)), {"neither <load> nor <contact>", "add <contact/>"});
  expect_parts(fault(scene("<contact/><gravity drained=\"30\"/>")), {"direction"});
  expect_parts(fault(scene("<contact/><gravity direction=\"0,1,0\"/>")), {"0 levels", "fluid_level, drained"});
  expect_parts(fault(scene("<contact/><gravity direction=\"0,1,0\" drained=\"30\" fluid_level=\"4\"/>")), {"2 levels"});
  expect_parts(fault(scene("<contact/><gravity direction=\"0,0,0\" drained=\"30\"/>")), {"0,0,0", "which way"});
  expect_parts(fault(scene("<contact/><gravity direction=\"0,1,0\" drained=\"130\"/>")), {"130", "100"});
  expect_parts(fault(scene("<contact/><gravity direction=\"0,1,0\" fluid_point=\"1,2\"/>")), {"three numbers"});
  expect_parts(fault(scene(drained + "<contact/>"), {"solve.gravity=0,0,-9.81"}), {"both <gravity>"});
  expect_parts(fault(scene(drained + load), {"solve.region=1"}), {"gravity"});
}

}  // namespace brainshift::pipelines::gravity_test
