// SPDX-License-Identifier: GPL-3.0-or-later
#include <vtkFeatureEdges.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkSphereSource.h>
#include <vtkTriangleFilter.h>

#include "builders.hpp"
#include "segmentation/segment.hpp"
#include "segmentation/surface/extract.hpp"
#include "segmentation/surface/vtk_bridge.hpp"

namespace brainshift::test {
namespace {

using namespace segmentation;

const Eigen::Vector3d centre(100.0, -50.0, 30.0);

double ball_volume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

vtkIdType open_or_shared_edges(const Surface& surface) {
  vtkNew<vtkFeatureEdges> edges;
  const auto data = to_vtk(surface);
  edges->SetInputData(data);
  edges->FeatureEdgesOff();
  edges->ManifoldEdgesOff();
  edges->Update();
  return edges->GetOutput()->GetNumberOfCells();
}

Surface sphere(double radius, int resolution) {
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  return from_vtk(*source->GetOutput());
}

void expect_sound(const SurfaceMeasures& measures) {
  EXPECT_TRUE(measures.closed);
  EXPECT_TRUE(measures.outward);
  EXPECT_FALSE(measures.self_intersecting);
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

TEST(Surface, DistanceToTheLabelsBoundaryIsThatOfTheVoxelsFaces) {
  const auto geometry = grid_around(centre, 31, Eigen::Vector3d::Ones(), oblique());
  Mask mask{geometry, std::vector<std::uint8_t>(geometry.voxel_count())};
  for (int k = 5; k < 26; ++k) {
    for (int j = 5; j < 26; ++j) {
      for (int i = 5; i < 26; ++i) {
        mask.at(i, j, k) = 1;
      }
    }
  }
  Surface plane;  // a triangle beside the face at index 25.5, 4 and 0.25 voxels away
  for (const double away : {4.0, 0.25}) {
    plane.vertices.resize(3, 3);
    plane.vertices.row(0) = geometry.to_world({10, 10, 25.5 + away}).transpose();
    plane.vertices.row(1) = geometry.to_world({20, 10, 25.5 + away}).transpose();
    plane.vertices.row(2) = geometry.to_world({10, 20, 25.5 + away}).transpose();
    plane.triangles.resize(1, 3);
    plane.triangles << 0, 1, 2;
    EXPECT_NEAR(boundary_distance_95(plane, mask), away, 1e-9);
  }
}

TEST(Surface, ADefectIsMeasuredAsWhatItIs) {
  Surface open = tetrahedron();
  open.triangles.conservativeResize(3, 3);
  EXPECT_FALSE(measure(open).closed);
  Surface inside_out = tetrahedron();
  inside_out.triangles.col(0).swap(inside_out.triangles.col(1));
  EXPECT_TRUE(measure(inside_out).closed);
  EXPECT_FALSE(measure(inside_out).outward);
  Surface two;  // two tetrahedra through each other
  two.vertices.resize(8, 3);
  two.vertices << tetrahedron().vertices, tetrahedron().vertices.array() + 2.0;
  two.triangles.resize(8, 3);
  two.triangles << tetrahedron().triangles, tetrahedron().triangles.array() + 4;
  EXPECT_TRUE(measure(two).closed);
  EXPECT_TRUE(measure(two).self_intersecting);
  expect_sound(measure(tetrahedron()));
}

TEST(CheckedSurface, ASoundSurfaceIsOnlyRemeshed) {
  const auto checked = checked_surface(sphere(30.0, 40), 5.0);
  expect_sound(checked.measures);
  EXPECT_FALSE(checked.measures.repaired);
  EXPECT_NEAR(checked.measures.volume, ball_volume(30.0), 0.03 * ball_volume(30.0));
}

TEST(CheckedSurface, AnInsideOutSurfaceIsTurned) {
  Surface surface = sphere(30.0, 40);
  surface.triangles.col(0).swap(surface.triangles.col(1));
  const auto checked = checked_surface(surface, 5.0);
  expect_sound(checked.measures);
  EXPECT_GT(checked.measures.volume, 0.0);
}

TEST(CheckedSurface, AHoleIsBridgedAndCounted) {
  Surface surface = sphere(30.0, 40);
  surface.triangles = surface.triangles.topRows(surface.triangles.rows() - 6).eval();
  ASSERT_FALSE(measure(surface).closed);
  const auto checked = checked_surface(surface, 6.0);
  expect_sound(checked.measures);
  EXPECT_TRUE(checked.measures.repaired);
  EXPECT_NEAR(checked.measures.volume, ball_volume(30.0), 0.06 * ball_volume(30.0));
}

TEST(CheckedSurface, TwoBallsThroughEachOtherBecomeOneBody) {
  Surface two;
  const Surface one = sphere(25.0, 30);
  two.vertices.resize(2 * one.vertices.rows(), 3);
  two.vertices << one.vertices, one.vertices.rowwise() + Eigen::RowVector3d(20.0, 0.1, 0.2);
  two.triangles.resize(2 * one.triangles.rows(), 3);
  two.triangles << one.triangles, one.triangles.array() + static_cast<std::int32_t>(one.vertices.rows());
  const auto checked = checked_surface(two, 5.0);
  expect_sound(checked.measures);
  EXPECT_TRUE(checked.measures.repaired);
  const double cap_height = 15.0;
  const double lens = 2.0 * std::numbers::pi * cap_height * cap_height * (3.0 * 25.0 - cap_height) / 3.0;
  const double expected = 2.0 * ball_volume(25.0) - lens;
  EXPECT_NEAR(checked.measures.volume, expected, 0.06 * expected);
}

TEST(CheckedSurface, AFlatSheetIsRefused) {
  Surface sheet = tetrahedron();
  sheet.triangles.conservativeResize(1, 3);
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { checked_surface(sheet, 5.0); }, {"surface"}));
  EXPECT_TRUE(throws_saying<std::invalid_argument>([] { checked_surface({}, 5.0); }, {"no triangle"}));
}

}  // namespace
}  // namespace brainshift::test
