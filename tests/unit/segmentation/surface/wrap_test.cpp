// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include "segmentation/surface/remesh.hpp"
#include "segmentation/surface/surface_measures.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::segmentation::wrap_test {

TEST(Wrap, EnclosesASurfaceWithAHoleAndLiesOutsideOfIt) {
  constexpr double radius = 20, opening = 8;
  const Eigen::Vector3d centre(-20, 30, 40);
  Surface body = test::sphere(centre, radius, 3);
  body.triangles = body.triangles.topRows(body.triangles.rows() - 4).eval();
  const Surface around = wrapped(body, opening);
  EXPECT_TRUE(measure(around).is_sound());
  EXPECT_GT(volume(around), volume(test::sphere(centre, radius, 3)));
  const double farthest = (around.vertices.rowwise() - centre.transpose()).rowwise().norm().maxCoeff();
  EXPECT_NEAR(farthest, radius + opening / 30, 0.05);
}

TEST(Wrap, GoesThroughAnOpeningThatIsWiderThanAsked) {
  constexpr double radius = 20;
  Surface bowl = test::sphere({0, 0, 0}, radius, 3);
  std::int32_t kept = 0;
  for (Eigen::Index triangle = 0; triangle < bowl.triangles.rows(); ++triangle) {
    if (brainshift::triangle(bowl, triangle).centroid().z() < 10) {
      bowl.triangles.row(kept++) = bowl.triangles.row(triangle).eval();
    }
  }
  bowl.triangles.conservativeResize(kept, 3);
  const double ball = 4.0 / 3 * std::numbers::pi * radius * radius * radius;
  const Surface around = wrapped(bowl, 4);
  EXPECT_TRUE(measure(around).is_sound());
  EXPECT_LT(volume(around), 0.1 * ball) << "the bowl's wall alone";
}

TEST(Wrap, EnclosesBallsThatAreApartEach) {
  Surface balls = test::sphere({0, 0, 0}, 10, 2);
  const Surface other = test::sphere({40, 0, 0}, 10, 2);
  const Eigen::Index vertices = balls.vertices.rows(), triangles = balls.triangles.rows();
  balls.vertices.conservativeResize(2 * vertices, 3);
  balls.vertices.bottomRows(vertices) = other.vertices;
  balls.triangles.conservativeResize(2 * triangles, 3);
  balls.triangles.bottomRows(triangles) = other.triangles.array() + static_cast<std::int32_t>(vertices);
  const Surface around = wrapped(balls, 6);
  EXPECT_TRUE(measure(around).closed);
  EXPECT_NEAR(volume(around), volume(balls), 0.1 * volume(balls));
}

}  // namespace brainshift::segmentation::wrap_test
