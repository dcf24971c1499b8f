// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/surface/checked_surface.hpp"

#include <gtest/gtest.h>

#include <vtkNew.h>
#include <vtkSphereSource.h>
#include <numbers>

#include "segmentation/files/vtk_bridge.hpp"
#include "segmentation/geometry/joined.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::checked_surface_test {

using namespace segmentation;

Surface sphere(double radius, int resolution) {
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  return from_vtk(*source->GetOutput());
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

TEST(CheckedSurface, AHoleIsClosedAndCounted) {
  Surface surface = sphere(30.0, 40);
  const double whole = volume(surface);
  surface.triangles.row(700).swap(surface.triangles.row(surface.triangles.rows() - 1));
  surface.triangles.conservativeResize(surface.triangles.rows() - 1, 3);
  for (const Surface& open : {surface, turned_over(surface)}) {
    ASSERT_FALSE(measure(open).closed);
    const auto checked = checked_surface(open, 3.0);
    expect_sound(checked.measures);
    EXPECT_FALSE(checked.measures.repaired);
    EXPECT_EQ(checked.closed_holes, 1U);
    EXPECT_NEAR(checked.measures.volume, whole, 0.01 * whole);
  }
}

TEST(CheckedSurface, ATriangleThatFacesTheWrongWayIsTurned) {
  Surface surface = sphere(30.0, 40);
  std::swap(surface.triangles(700, 0), surface.triangles(700, 1));
  const auto checked = checked_surface(surface, 5.0);
  expect_sound(checked.measures);
  EXPECT_FALSE(checked.measures.repaired);
  EXPECT_EQ(checked.closed_holes, 0U);
}

TEST(CheckedSurface, AWideHoleIsWrappedAndCounted) {
  const Surface surface = without_top(sphere(30.0, 40), 0.05);
  const auto checked = checked_surface(surface, 6.0);
  expect_sound(checked.measures);
  EXPECT_TRUE(checked.measures.repaired);
  EXPECT_EQ(checked.closed_holes, 0U);
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

Surface moved(Surface surface, double by) {
  surface.vertices.col(0).array() += by;
  return surface;
}

TEST(CheckedSurface, KeepsTheLargestBodyWithItsCavitiesAndCountsTheRest) {
  Surface cavity = sphere(12.0, 30);
  cavity.triangles.col(0).swap(cavity.triangles.col(1));
  const auto checked = checked_surface(joined(joined(moved(sphere(8.0, 20), 60), sphere(30.0, 40)), cavity), 4.0);
  expect_sound(checked.measures);
  EXPECT_FALSE(checked.measures.repaired);
  const double expected = ball_volume(30.0) - ball_volume(12.0);
  EXPECT_NEAR(checked.measures.volume, expected, 0.03 * expected);
  EXPECT_LT(checked.surface.vertices.col(0).maxCoeff(), 31);
  EXPECT_EQ(checked.loose_pieces, 1U);
  EXPECT_NEAR(checked.loose_volume, ball_volume(8.0), 0.25 * ball_volume(8.0)) << "of coarse triangles";
}

TEST(CheckedSurface, ADroppedBodyTakesItsCavityAlong) {
  Surface cavity = moved(sphere(5.0, 20), 60);
  cavity.triangles.col(0).swap(cavity.triangles.col(1));
  const auto checked = checked_surface(joined(joined(moved(sphere(12.0, 20), 60), cavity), sphere(30.0, 40)), 3.0);
  expect_sound(checked.measures);
  EXPECT_LT(checked.surface.vertices.col(0).maxCoeff(), 31);
}

TEST(CheckedSurface, TwoBodiesOfASizeAreRefused) {
  const Surface two = joined(sphere(30.0, 40), moved(sphere(28.0, 40), 70));
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { checked_surface(two, 5.0); },
                                                   {"more than one body", "112 and 91 ml"}));
}

TEST(CheckedSurface, AFlatSheetIsRefused) {
  Surface sheet = tetrahedron();
  sheet.triangles.conservativeResize(1, 3);
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { checked_surface(sheet, 5.0); }, {"surface"}));
  EXPECT_TRUE(throws_saying<std::invalid_argument>([] { checked_surface({}, 5.0); }, {"no triangle"}));
  Surface flat = tetrahedron();
  flat.vertices.col(2) = flat.vertices.col(0) + flat.vertices.col(1);
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { checked_surface(flat, 5.0); }, {"plane"}));
}

}  // namespace brainshift::test::checked_surface_test
