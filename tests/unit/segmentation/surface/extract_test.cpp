// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/surface/extract.hpp"

#include <gtest/gtest.h>

#include <vtkFeatureEdges.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <random>
#include <stdexcept>
#include <string>

#include "segmentation/files/vtk_bridge.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::extract_test {

using namespace segmentation;

const Eigen::Vector3d centre(100.0, -50.0, 30.0);

vtkIdType open_or_shared_edges(const Surface& surface) {
  vtkNew<vtkFeatureEdges> edges;
  const auto data = to_vtk(surface);
  edges->SetInputData(data);
  edges->FeatureEdgesOff();
  edges->ManifoldEdgesOff();
  edges->Update();
  return edges->GetOutput()->GetNumberOfCells();
}

struct Frame {
  const char* name;
  Eigen::Matrix3d direction;
  Eigen::Vector3d spacing;
};

class BallInAFrame : public ::testing::TestWithParam<Frame> {};
INSTANTIATE_TEST_SUITE_P(Surface, BallInAFrame,
                         ::testing::Values(Frame{"Identity", Eigen::Matrix3d::Identity(), {1.0, 1.0, 1.0}},
                                           Frame{"Oblique", oblique(), {1.0, 1.0, 1.0}},
                                           Frame{"ObliqueLeftHanded", oblique_left_handed(), {1.0, 1.0, 1.0}},
                                           Frame{"ThickSlices", oblique_left_handed(), {0.8, 0.8, 2.0}}),
                         [](const auto& named) { return named.param.name; });

TEST_P(BallInAFrame, HasItsRadiusItsVolumeAndFacesOutward) {
  const double radius = 20.0;
  const auto geometry = grid_around(centre, 64, GetParam().spacing, GetParam().direction);
  const auto extracted = extract_surface(mask_of(ball(geometry, centre, radius)), 4.0, "ball");
  expect_sound(extracted.measures);
  EXPECT_FALSE(extracted.measures.repaired);
  EXPECT_NEAR(extracted.measures.volume, ball_volume(radius), 0.01 * ball_volume(radius));
  EXPECT_LE(extracted.measures.boundary_distance_95, 1.0);
  EXPECT_NEAR(extracted.measures.edge_length_mean, 4.0, 0.8);
  const auto radii = (extracted.surface.vertices.rowwise() - centre.transpose()).rowwise().norm();
  EXPECT_NEAR(radii.minCoeff(), radius, 0.8);
  EXPECT_NEAR(radii.maxCoeff(), radius, 0.8);
}

TEST(Surface, VtkAgreesThatABallIsClosedAndOnItsVolume) {
  const auto geometry = grid_around(centre, 40, Eigen::Vector3d::Ones(), oblique_left_handed());
  const auto extracted = extract_surface(mask_of(ball(geometry, centre, 15.0)), 3.0, "ball");
  EXPECT_EQ(open_or_shared_edges(extracted.surface), 0);
  vtkNew<vtkMassProperties> mass;
  const auto data = to_vtk(extracted.surface);
  mass->SetInputData(data);
  EXPECT_NEAR(mass->GetVolume(), extracted.measures.volume, 1e-3 * extracted.measures.volume);
}

TEST(Surface, AVoxelAloneHasAClosedSurfaceOfItsVolume) {
  const auto geometry = grid_around(centre, 5, {1.0, 1.0, 1.0}, oblique());
  Mask mask{geometry, std::vector<std::uint8_t>(geometry.voxel_count())};
  mask.at(2, 2, 2) = 1;
  const auto extracted = extract_surface(mask, 5.0, "voxel");
  expect_sound(extracted.measures);
  EXPECT_NEAR(extracted.measures.volume, 1.0, 0.01);
  EXPECT_LT(extracted.measures.edge_length_target, 5.0);
}

TEST(Surface, AThinSheetIsGivenFinerEdgesAndKeepsItsVolume) {
  const auto geometry = grid_around(centre, 40, Eigen::Vector3d::Ones(), Eigen::Matrix3d::Identity());
  Mask mask{geometry, std::vector<std::uint8_t>(geometry.voxel_count())};
  for (int k = 18; k < 21; ++k) {
    for (int j = 8; j < 32; ++j) {
      for (int i = 8; i < 32; ++i) {
        mask.at(i, j, k) = 1;
      }
    }
  }
  const auto extracted = extract_surface(mask, 6.0, "sheet");
  expect_sound(extracted.measures);
  EXPECT_LT(extracted.measures.edge_length_target, 6.0);
  EXPECT_NEAR(extracted.measures.volume, 3.0 * 24 * 24, 0.01 * 3 * 24 * 24);
  EXPECT_LE(extracted.measures.boundary_distance_95, 1.0);
}

TEST(Surface, AShellHasAnInnerSurfaceThatFacesItsHollow) {
  const auto geometry = grid_around(centre, 56, Eigen::Vector3d::Ones(), oblique_left_handed());
  Mask shell = mask_of(ball(geometry, centre, 22.0));
  const Mask hollow = mask_of(ball(geometry, centre, 10.0));
  for (std::size_t i = 0; i < shell.voxels.size(); ++i) {
    shell.voxels[i] = shell.voxels[i] != 0 && hollow.voxels[i] == 0 ? 1 : 0;
  }
  const auto extracted = extract_surface(shell, 4.0, "shell");
  expect_sound(extracted.measures);
  const double expected = ball_volume(22.0) - ball_volume(10.0);
  EXPECT_NEAR(extracted.measures.volume, expected, 0.02 * expected);
}

// Less than half of the voxels, strewn: their contour has more triangles than are remeshed, and a smoother one has
// none.
TEST(Surface, OfWhatSmoothingLeavesNothingOfIsRefusedWithAReason) {
  const auto geometry = grid_around(centre, 150, Eigen::Vector3d::Ones(), Eigen::Matrix3d::Identity());
  Mask strewn = mask_of(ball(geometry, centre, 70.0));
  std::mt19937 random(3);
  for (std::uint8_t& voxel : strewn.voxels) {
    voxel = voxel != 0 && std::bernoulli_distribution(0.42)(random) ? 1 : 0;
  }
  try {
    extract_surface(strewn, 5.0, "brain");
    FAIL() << "it is taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("the brain is so full of gaps"), std::string::npos) << error.what();
  }
}

}  // namespace brainshift::test::extract_test
