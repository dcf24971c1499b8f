// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/body/scanlines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::discretise::scanlines_test {

using test::box;
using test::sphere;

std::vector<double> crossings(const Scanlines& body, double y, double z) {
  std::vector<double> x = {1, 2, 3};
  body.crossings(y, z, x);
  return x;
}

TEST(Scanlines, PassThroughABoxAtItsSides) {
  const Scanlines body(box({1, 2, 3}, {4, 6, 9}));
  const std::vector<double> x = crossings(body, 2.7, 8.1);
  ASSERT_EQ(x.size(), 2U);
  EXPECT_NEAR(x[0], 1, 1e-12);
  EXPECT_NEAR(x[1], 4, 1e-12);
  EXPECT_TRUE(crossings(body, 1.9, 8.1).empty());
  EXPECT_TRUE(crossings(body, 2.7, 9.1).empty());
}

TEST(Scanlines, PassThroughABoxTwiceWhereTheyMeetADiagonalExactly) {
  const Scanlines body(box({0, 0, 0}, {4, 4, 4}));
  for (const double along : {0.5, 1.0, 2.0, 3.25}) {
    EXPECT_EQ(crossings(body, along, along).size(), 2U) << along;
    EXPECT_EQ(crossings(body, along, 4 - along).size(), 2U) << along;
  }
}

TEST(Scanlines, PassThroughAPartOfABody) {
  const Scanlines body(box({0, 0, 0}, {10, 10, 10}));
  const auto hole = std::make_shared<const Scanlines>(box({4, 2, 2}, {6, 12, 8}));
  const Scanlines within(body, hole, true), outside(body, hole, false);
  EXPECT_EQ(crossings(outside, 1, 5), crossings(body, 1, 5));
  EXPECT_TRUE(crossings(within, 1, 5).empty());
  const std::vector<double> around = crossings(outside, 5.1, 5.3), through = crossings(within, 5.1, 5.3);
  ASSERT_EQ(around.size(), 4U);
  ASSERT_EQ(through.size(), 2U);
  EXPECT_NEAR(around[1], 4, 1e-12);
  EXPECT_NEAR(around[2], 6, 1e-12);
  EXPECT_NEAR(through[0], 4, 1e-12);
  EXPECT_NEAR(through[1], 6, 1e-12);
  EXPECT_TRUE(crossings(within, 11, 5).empty()) << "outside the body";
  EXPECT_TRUE(within.inside({5, 5, 5}));
  EXPECT_FALSE(outside.inside({5, 5, 5}));
  EXPECT_TRUE(outside.inside({3, 5, 5}));
  EXPECT_FALSE(within.inside({5, 11, 5}));
}

TEST(Scanlines, HaveAnEvenNumberOfCrossingsThroughVerticesAndEdges) {
  const Eigen::Vector3d centre(-20, 30, 40);
  const Surface ball = sphere(centre, 10, 2);
  const Scanlines body(ball);
  for (const auto& vertex : ball.vertices.rowwise()) {
    const std::vector<double> x = crossings(body, vertex[1], vertex[2]);
    ASSERT_EQ(x.size() % 2, 0U);
    const double from_axis = (vertex.tail<2>() - centre.tail<2>().transpose()).norm();
    if (from_axis < 9) {  // well within the outline
      ASSERT_EQ(x.size(), 2U);
      EXPECT_NEAR(0.5 * (x[0] + x[1]), centre.x(), 0.3);
    }
  }
}

TEST(Scanlines, SeeTheHollowOfAShell) {
  const Surface outer = sphere({0, 0, 0}, 10, 3);
  Surface inner = sphere({0, 0, 0}, 5, 3);
  inner.triangles.col(0).swap(inner.triangles.col(1));
  Surface shell{Points(outer.vertices.rows() + inner.vertices.rows(), 3),
                Triangles(outer.triangles.rows() + inner.triangles.rows(), 3)};
  shell.vertices << outer.vertices, inner.vertices;
  shell.triangles << outer.triangles, inner.triangles.array() + static_cast<std::int32_t>(outer.vertices.rows());
  const Scanlines body(shell);
  const std::vector<double> x = crossings(body, 0.31, -0.17);
  ASSERT_EQ(x.size(), 4U);
  const double expected[] = {-10, -5, 5, 10};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(x[i], expected[i], 0.1);
  }
  EXPECT_FALSE(body.inside({0, 0.31, -0.17}));
  EXPECT_TRUE(body.inside({7, 0.31, -0.17}));
}

TEST(Scanlines, TellInsideFromOutsideOfABall) {
  const Eigen::Vector3d centre(-20, 30, 40);
  const Scanlines body(sphere(centre, 10, 4));
  std::mt19937 random(4);
  std::uniform_real_distribution<double> within(-12, 12);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d offset(within(random), within(random), within(random));
    if (std::abs(offset.norm() - 10) > 0.05) {  // between the triangles and the ball
      EXPECT_EQ(body.inside(centre + offset), offset.norm() < 10);
    }
  }
}

TEST(Scanlines, APlaceOnTheSideThatALineEntersByIsNotInside) {
  const Scanlines body(box({0, 0, 0}, {4, 4, 4}));
  EXPECT_FALSE(body.inside({-1, 1, 2}));
  EXPECT_TRUE(body.inside({1e-9, 1, 2}));
  EXPECT_TRUE(body.inside({4 - 1e-9, 1, 2}));
  EXPECT_FALSE(body.inside({4 + 1e-9, 1, 2}));
}

}  // namespace brainshift::discretise::scanlines_test
