// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/phantom/opening.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace brainshift::pipelines::opening_test {

using Eigen::Vector3d;

const Vector3d centre(10, -20, 30);

TEST(Opening, LiesOnTheBrainOverTheTumour) {
  for (const double scale : {1.0, 0.4}) {
    const Head head = make_head(centre, scale, 2);
    const Opening opening = make_opening(head);
    EXPECT_NEAR(head.brain.level(opening.centre), 1, 1e-9);
    const Vector3d to_tumour = (head.tumour.centre - centre).normalized();
    EXPECT_NEAR((opening.centre - centre).normalized().dot(to_tumour), 1, 1e-12);
    EXPECT_EQ(opening.radius, 26 * scale);
    EXPECT_EQ(opening.depth, 8 * scale);
  }
}

TEST(Opening, HasTheOutwardNormalOfTheBrain) {
  const Head head = make_head(centre, 1, 0);
  const Opening opening = make_opening(head);
  EXPECT_NEAR(opening.normal.norm(), 1, 1e-12);
  EXPECT_GT(head.brain.level(opening.centre + opening.normal), 1);
  EXPECT_LT(head.brain.level(opening.centre - opening.normal), 1);
  const Vector3d across = opening.normal.unitOrthogonal();
  EXPECT_NEAR(head.brain.level(opening.centre + 0.01 * across), 1, 1e-5) << "along the surface";
  EXPECT_NEAR(head.brain.level(opening.centre - 0.01 * across), 1, 1e-5);
}

TEST(MeasuredLoad, LiesOnTheExposedCortexAllOverTheOpening) {
  const Head head = make_head(centre, 1, 0);
  const Opening opening = make_opening(head);
  const solve::CraniotomyLoad load = measured_load(head, opening);
  ASSERT_EQ(load.positions.rows(), 90);
  ASSERT_EQ(load.displacement.rows(), 90);
  double farthest = 0;
  Vector3d mean = Vector3d::Zero();
  for (const auto& row : load.positions.rowwise()) {
    const Vector3d offset = row.transpose() - opening.centre;
    EXPECT_NEAR(head.brain.level(row.transpose()), 1, 1e-9);
    const Vector3d in_plane = offset - offset.dot(opening.normal) * opening.normal;
    farthest = std::max(farthest, in_plane.norm());
    mean += in_plane / 90;
  }
  EXPECT_LE(farthest, opening.radius);
  EXPECT_GT(farthest, 0.97 * opening.radius);
  EXPECT_LT(mean.norm(), 0.05 * opening.radius);
}

TEST(MeasuredLoad, SinksAlongTheNormalMostAtTheCentreAndLittleAtTheRim) {
  const Head head = make_head(centre, 0.5, 0);
  const Opening opening = make_opening(head);
  const solve::CraniotomyLoad load = measured_load(head, opening);
  for (Eigen::Index i = 0; i < load.positions.rows(); ++i) {
    const Vector3d offset = load.positions.row(i).transpose() - opening.centre;
    const double r = (offset - offset.dot(opening.normal) * opening.normal).norm();
    const double sink = opening.depth * (1 + std::cos(0.8 * std::numbers::pi * r / opening.radius)) / 2;
    EXPECT_NEAR((load.displacement.row(i).transpose() + sink * opening.normal).norm(), 0, 1e-9);
  }
  const auto sunk = load.displacement.rowwise().norm();
  EXPECT_GT(sunk.maxCoeff(), 0.98 * opening.depth);
  EXPECT_LT(sunk.minCoeff(), 0.12 * opening.depth);
}

}  // namespace brainshift::pipelines::opening_test
