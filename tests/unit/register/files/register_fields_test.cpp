// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/register_fields.hpp"

#include <gtest/gtest.h>
#include <vtkPointData.h>

#include <numeric>

#include "segmentation/files/vtu_file.hpp"
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

TEST(RegisterFields, KnowWhatWasTakenOutInEitherBrain) {
  const test::ScratchFolder folder;
  const auto write_shift = [&](const char* name, double x) {
    write_image(folder / name,
                field(grid({8, 4, 4}), [&](const Eigen::Vector3d&) { return Eigen::Vector3d(x, 0, 0); }));
  };
  write_shift(forward_name, 2);
  write_shift(resampling_name, -2);
  LabelMap removed{grid({8, 4, 4}), std::vector<std::uint16_t>(8 * 4 * 4, 0)};
  const Eigen::Vector3d taken = removed.geometry.to_world({3, 1, 1}), moved = taken + Eigen::Vector3d(2, 0, 0);
  removed.at(3, 1, 1) = 1;
  write_image(folder / removed_name, removed);
  RegisterFields there(folder.path(), Towards::intraop), back(folder.path(), Towards::preop);
  EXPECT_TRUE(there.is_removed(taken));
  EXPECT_FALSE(there.is_removed(moved));
  EXPECT_TRUE(there.removed().has_value());
  EXPECT_TRUE(back.is_removed(moved));
  EXPECT_FALSE(back.is_removed(taken));
  EXPECT_FALSE(back.removed().has_value()) << "images of the intraop brain have it no more";
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
  const auto before = there.values_of_points(preop), after = back.values_of_points(intraop);
  ASSERT_TRUE(before.size() == 1 && after.size() == 1);
  EXPECT_EQ(before[0].name, "estimated_error");
  for (Eigen::Index node = 0; node < 20; ++node) {
    EXPECT_NEAR(before[0].values[static_cast<std::size_t>(node)], error_at(preop.row(node)), 1e-9);
    EXPECT_NEAR(after[0].values[static_cast<std::size_t>(node)], error_at(preop.row(node)), 1e-9);
  }
}

TEST_F(RegisterFieldsError, OfAPlaceFarFromTheBrainIsNotKnown) {
  RegisterFields there(folder_.path(), Towards::intraop, folder_ / "solution.vtu");
  const Points far = (Points(1, 3) << 0, 0, 500).finished();
  EXPECT_TRUE(std::isnan(there.values_of_points(far)[0].values[0]));
}

TEST_F(RegisterFieldsError, OfAnImageIsAsLargeAtTheSurfaceAsInside) {
  RegisterFields there(folder_.path(), Towards::intraop, folder_ / "solution.vtu");
  const ScalarImage error = there.values_on(grid({30, 30, 30}, {2.5, 2.5, 2.5}, oblique()))[0].second;
  for_each_voxel(error.geometry, [&](const Eigen::Vector3d& x, std::size_t v) {
    if ((x - centre - Eigen::Vector3d(0, 0, -5)).norm() < radius) {
      ASSERT_NEAR(error.voxels[v], error_at(x), 0.1);
    }
  });
}

TEST_F(RegisterFieldsError, OfAnImageIsThatOfItsVoxelsInTheWarpedBrain) {
  RegisterFields there(folder_.path(), Towards::intraop, folder_ / "solution.vtu");
  const auto images = there.values_on(grid({30, 30, 30}, {2.5, 2.5, 2.5}, oblique()));
  ASSERT_EQ(images.size(), 1U);
  const ScalarImage& error = images[0].second;
  for_each_voxel(error.geometry, [&](const Eigen::Vector3d& x, std::size_t v) {
    const double from_middle = (x - centre - Eigen::Vector3d(0, 0, -5)).norm();
    if (from_middle < radius - 8) {
      ASSERT_NEAR(error.voxels[v], error_at(x), 0.03);  // of nodes 5 mm apart and voxels of 4 mm
    } else if (from_middle > radius + 14) {
      ASSERT_EQ(error.voxels[v], 0);
    }
  });
}

TEST_F(RegisterFieldsError, TheStandardDeviationBesideTheSolutionGoesAlong) {
  const auto write_deviations = [&](std::size_t nodes) {
    const auto grid = vtu::vertex_grid(solution_.positions.topRows(static_cast<Eigen::Index>(nodes)));
    std::vector<double> values(nodes);
    std::iota(values.begin(), values.end(), 1);
    vtu::add_array(*grid->GetPointData(), "uncertainty", values);
    vtu::write(folder_ / "uncertainty.vtu", *grid);
  };
  const auto count = static_cast<std::size_t>(solution_.positions.rows());
  write_deviations(count);
  RegisterFields fields(folder_.path(), Towards::intraop, folder_ / "solution.vtu");
  const auto values = fields.values_of_points(solution_.positions.topRows(5));
  ASSERT_EQ(values.size(), 2U);
  EXPECT_EQ(values[1].name, "uncertainty");
  for (std::size_t node = 0; node < 5; ++node) {
    EXPECT_NEAR(values[1].values[node], static_cast<double>(node + 1), 1e-6);
  }
  EXPECT_EQ(fields.values_on(grid({4, 4, 4}))[1].first, "uncertainty");
  write_deviations(count - 1);
  RegisterFields other(folder_.path(), Towards::intraop, folder_ / "solution.vtu");
  EXPECT_NE(test::refusal([&] { other.values_of_points(solution_.positions); }).find("solve again"), std::string::npos);
}

TEST_F(RegisterFieldsError, IsNotKnownWithoutAnEstimateOrASolution) {
  RegisterFields without(folder_.path(), Towards::intraop);
  EXPECT_TRUE(without.values_of_points(Points::Zero(1, 3)).empty());
  solution_.estimated_error.clear();
  write_solution(folder_ / "solution.vtu", solution_);
  RegisterFields fields(folder_.path(), Towards::intraop, folder_ / "solution.vtu");
  EXPECT_TRUE(fields.values_on(grid({4, 4, 4})).empty());
}

TEST(RegisterFields, AFolderWithoutThemIsRefused) {
  const test::ScratchFolder folder;
  const std::string said = test::refusal([&] { RegisterFields(folder.path(), Towards::intraop); });
  EXPECT_NE(said.find("preop_to_intraop.nii.gz"), std::string::npos);
  EXPECT_NE(said.find("finished run"), std::string::npos);
}

}  // namespace brainshift::registration::register_fields_test
