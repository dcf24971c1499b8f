// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/register_fields.hpp"

#include <gtest/gtest.h>

#include "solve/output/solution_file.hpp"
#include "tests/unit/register/builders.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::register_fields_test {

using namespace builders;

TEST(RegisterFields, PointsTakeTheMapThatGoesTheirWayAndImagesTheOneThatComesBack) {
  const test::ScratchFolder folder;
  const auto write_shift = [&](const char* name, double x) {
    write_image(folder / name,
                field(grid({4, 4, 4}), [&](const Eigen::Vector3d&) { return Eigen::Vector3d(x, 0, 0); }));
  };
  write_shift("preop_to_intraop.nii.gz", 1);
  write_shift("intraop_to_preop.nii.gz", -1);
  RegisterFields there(folder.path(), Towards::intraop), back(folder.path(), Towards::preop);
  EXPECT_EQ(there.of_points().at(0, 0, 0)[0], 1);
  EXPECT_EQ(there.of_images().at(0, 0, 0)[0], -1);
  EXPECT_EQ(back.of_points().at(0, 0, 0)[0], -1);
  EXPECT_EQ(back.of_images().at(0, 0, 0)[0], 1);
}

/// A run whose solution has an error that grows to the left.
class RegisterFieldsError : public ::testing::Test {
 protected:
  RegisterFieldsError() {
    for (const char* name : {"preop_to_intraop.nii.gz", "intraop_to_preop.nii.gz"}) {
      write_image(folder_ / name, field(grid({4, 4, 4}), sinking));
    }
    for (Eigen::Index node = 0; node < solution_.positions.rows(); ++node) {
      solution_.estimated_error.push_back(error_at(solution_.positions.row(node)));
    }
    write_solution(folder_ / "solution.vtu", solution_);
  }
  static double error_at(const Eigen::Vector3d& place) { return 1 + 0.01 * place.x(); }

  test::ScratchFolder folder_;
  Solution solution_ = solution([](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, -5); });
};

TEST_F(RegisterFieldsError, IsThatOfTheNodesAboutThePlaceInTheBrainItIsIn) {
  RegisterFields there(folder_.path(), Towards::intraop, folder_ / "solution.vtu"),
      back(folder_.path(), Towards::preop, folder_ / "solution.vtu");
  const Points preop = solution_.positions.topRows(20), intraop = preop.rowwise() + Eigen::RowVector3d(0, 0, -5);
  const auto before = there.error_of_points(preop), after = back.error_of_points(intraop);
  ASSERT_TRUE(before && after);
  for (Eigen::Index node = 0; node < 20; ++node) {
    EXPECT_NEAR((*before)[static_cast<std::size_t>(node)], error_at(preop.row(node)), 1e-9);
    EXPECT_NEAR((*after)[static_cast<std::size_t>(node)], error_at(preop.row(node)), 1e-9);
  }
}

TEST_F(RegisterFieldsError, OfAnImageIsThatOfItsVoxelsInTheWarpedBrain) {
  RegisterFields there(folder_.path(), Towards::intraop, folder_ / "solution.vtu");
  const auto error = there.error_on(grid({30, 30, 30}, {2.5, 2.5, 2.5}, oblique()));
  ASSERT_TRUE(error);
  for_each_voxel(error->geometry, [&](const Eigen::Vector3d& x, std::size_t v) {
    const double from_middle = (x - centre - Eigen::Vector3d(0, 0, -5)).norm();
    if (from_middle < radius - 8) {
      ASSERT_NEAR(error->voxels[v], error_at(x), 0.03);  // of nodes 5 mm apart and voxels of 4 mm
    } else if (from_middle > radius + 12) {
      ASSERT_EQ(error->voxels[v], 0);
    }
  });
}

TEST_F(RegisterFieldsError, IsNotKnownWithoutAnEstimateOrASolution) {
  RegisterFields without(folder_.path(), Towards::intraop);
  EXPECT_FALSE(without.error_of_points(Points::Zero(1, 3)));
  solution_.estimated_error.clear();
  write_solution(folder_ / "solution.vtu", solution_);
  RegisterFields fields(folder_.path(), Towards::intraop, folder_ / "solution.vtu");
  EXPECT_FALSE(fields.error_on(grid({4, 4, 4})));
}

TEST(RegisterFields, AFolderWithoutThemIsRefused) {
  const test::ScratchFolder folder;
  const std::string said = test::refusal([&] { RegisterFields(folder.path(), Towards::intraop); });
  EXPECT_NE(said.find("preop_to_intraop.nii.gz"), std::string::npos);
  EXPECT_NE(said.find("finished run"), std::string::npos);
}

}  // namespace brainshift::registration::register_fields_test
