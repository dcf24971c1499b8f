// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/phantom/cylinder.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "pipelines/scene/check_scene.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/surface/surface_measures.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::cylinder_test {

class CylinderFolder : public testing::Test {
 protected:
  void SetUp() override { write_cylinder(out_); }

  brainshift::test::ScratchFolder scratch_;
  std::filesystem::path out_ = scratch_ / "made";
};

TEST_F(CylinderFolder, HoldsASoundCylinderOfItsVolumeOnAPlate) {
  const Surface cylinder = read_surface(out_ / "cylinder.vtp"), plate = read_surface(out_ / "plate.vtp");
  EXPECT_TRUE(segmentation::measure(cylinder).is_sound());
  EXPECT_TRUE(segmentation::measure(plate).is_sound());
  const double polygon = 0.5 * 120 * 50 * 50 * std::sin(2 * std::numbers::pi / 120);  // of 120 corners
  EXPECT_NEAR(volume(cylinder), 100 * polygon, 1e-3);
  EXPECT_EQ(cylinder.vertices.col(2).minCoeff(), plate.vertices.col(2).minCoeff()) << "it stands on it";
  EXPECT_GT(plate.vertices.col(0).maxCoeff(), 1.2 * cylinder.vertices.col(0).maxCoeff());
  EXPECT_GT(plate.vertices.col(2).maxCoeff(), cylinder.vertices.col(2).maxCoeff());
}

TEST_F(CylinderFolder, PressesItsTopDownByATenth) {
  const solve::CraniotomyLoad load = solve::read_craniotomy_csv(out_ / "craniotomy.csv");
  ASSERT_GT(load.positions.rows(), 100);
  EXPECT_TRUE((load.positions.col(2).array() == 100).all());
  EXPECT_NEAR(load.positions.leftCols(2).rowwise().norm().maxCoeff(), 50, 1e-6);
  EXPECT_TRUE(load.displacement.leftCols(2).isZero());
  EXPECT_TRUE((load.displacement.col(2).array() == -10).all());
}

TEST_F(CylinderFolder, HasASceneThatPassesItsCheck) {
  const Scene scene = parse_scene(out_ / "scene.xml", {});
  EXPECT_NO_THROW(check_scene(scene));
}

TEST(Cylinder, ThatCannotBeWrittenIsAFaultOfOutput) {
  const brainshift::test::ScratchFolder scratch;
  const auto file = scratch.write("file", "x");
  EXPECT_THROW(write_cylinder(file / "out"), std::runtime_error);
}

}  // namespace brainshift::pipelines::cylinder_test
