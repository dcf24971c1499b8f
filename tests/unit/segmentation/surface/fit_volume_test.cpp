// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "segmentation/surface/extract.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::segmentation::fit_volume_test {

const Eigen::Vector3d centre(-20, 30, 40);

TEST(FitVolume, ScalesABallInItsPlace) {
  for (const double factor : {0.7, 0.98, 1.05, 1.5}) {
    Surface body = test::sphere(centre, 20, 3);
    const double wanted = factor * volume(body);
    fit_volume(body, wanted);
    EXPECT_NEAR(volume(body), wanted, 1e-4 * wanted);
    const Eigen::VectorXd radii = (body.vertices.rowwise() - centre.transpose()).rowwise().norm();
    EXPECT_NEAR(radii.minCoeff(), 20 * std::cbrt(factor), 0.05);
    EXPECT_NEAR(radii.maxCoeff(), 20 * std::cbrt(factor), 0.05);
  }
}

TEST(FitVolume, LeavesASurfaceThatFitsAlone) {
  Surface body = test::sphere(centre, 20, 2);
  const Points before = body.vertices;
  fit_volume(body, volume(body) * 1.00005);
  EXPECT_EQ(body.vertices, before);
}

TEST(FitVolume, MovesEveryVertexByTheSameDistance) {
  Surface body = test::box({0, 0, 0}, {10, 20, 30});
  const Points before = body.vertices;
  fit_volume(body, 6100);
  const Eigen::VectorXd moved = (body.vertices - before).rowwise().norm();
  EXPECT_GT(moved.minCoeff(), 0.01);
  EXPECT_NEAR(moved.maxCoeff(), moved.minCoeff(), 0.02 * moved.maxCoeff());
}

}  // namespace brainshift::segmentation::fit_volume_test
