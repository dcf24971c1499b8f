// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "segmentation/surface/extract.hpp"
#include "segmentation/surface/surface_measures.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::iso_surface_test {

using segmentation::iso_surface;

const Eigen::Vector3d centre(100, -50, 30);

Mask ball_mask(double radius, const Eigen::Matrix3d& direction) {
  const int size = 2 * static_cast<int>(radius) + 9;
  return mask_of(ball(grid_around(centre, size, Eigen::Vector3d::Ones(), direction), centre, radius));
}

double mean_radius(const Surface& surface) {
  return (surface.vertices.rowwise() - centre.transpose()).rowwise().norm().mean();
}

TEST(IsoSurface, OfABallIsClosedAndFacesOutwardInEveryFrame) {
  for (const Eigen::Matrix3d& direction : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), oblique_left_handed()}) {
    for (const double sigma : {0.0, 1.0}) {
      const Surface surface = iso_surface(ball_mask(12, direction), sigma);
      const segmentation::SurfaceMeasures measures = segmentation::measure(surface);
      EXPECT_TRUE(measures.closed && measures.outward) << sigma;
      EXPECT_NEAR(mean_radius(surface), 12, 0.3) << sigma;
    }
  }
}

TEST(IsoSurface, AGaussianShrinksABallByItsVarianceOverTheRadius) {
  constexpr double radius = 15;
  const Mask mask = ball_mask(radius, oblique());
  const double unsmoothed = mean_radius(iso_surface(mask, 0.7));
  for (const double sigma : {2.0, 3.0}) {
    const double shrunk = (sigma * sigma - 0.7 * 0.7) / radius;
    EXPECT_NEAR(unsmoothed - mean_radius(iso_surface(mask, sigma)), shrunk, 0.1 * sigma);
  }
}

TEST(IsoSurface, OfABallThatTouchesTheImagesBorderIsClosed) {
  const auto geometry = grid_around(centre, 16, Eigen::Vector3d::Ones(), oblique());
  const Mask mask = mask_of(ball(geometry, centre, 9));
  ASSERT_TRUE(touches_border(mask));
  EXPECT_TRUE(segmentation::measure(iso_surface(mask, 0.6)).closed);
}

TEST(IsoSurface, OfWhatTheSmoothingLeavesNothingOfHasNoTriangle) {
  const auto geometry = grid_around(centre, 9, Eigen::Vector3d::Ones(), oblique());
  const Mask voxel = mask_of(ball(geometry, centre, 0.5));
  ASSERT_EQ(count(voxel), 1U);
  EXPECT_GT(iso_surface(voxel, 0).triangles.rows(), 0);
  EXPECT_EQ(iso_surface(voxel, 2).triangles.rows(), 0);
}

}  // namespace brainshift::test::iso_surface_test
