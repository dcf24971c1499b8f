// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/triangle_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "segmentation/geometry/triangle_distance.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::triangle_tree_test {

std::vector<Triangle> triangles_of(const Surface& surface) {
  std::vector<Triangle> all;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    all.push_back(triangle(surface, t));
  }
  return all;
}

double distance(const Triangle& t, const Eigen::Vector3d& x) {
  return (nearest_on_triangle(frame_of(t), x).point - x).norm();
}

TEST(TriangleTree, FindsTheTriangleThatLookingAtAllFinds) {
  const std::vector<Triangle> triangles = triangles_of(test::sphere({-20, 30, 40}, 10, 2));
  const TriangleTree tree(triangles);
  const Points places = 30 * Points::Random(50, 3);
  for (const auto& place : places.rowwise()) {
    const Eigen::Vector3d x = place.transpose() + Eigen::Vector3d(-20, 30, 40);
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : triangles) {
      least = std::min(least, distance(t, x));
    }
    EXPECT_NEAR(std::sqrt(tree.squared_distance(x)), least, 1e-9);
    EXPECT_NEAR(distance(triangles[tree.nearest(x)], x), least, 1e-9);
  }
}

TEST(TriangleTree, FindsTheTrianglesThatASegmentMeets) {
  const std::vector<Triangle> triangles = triangles_of(test::box({0, 0, 0}, {4, 4, 4}));
  const TriangleTree tree(triangles);
  std::vector<std::size_t> found = {7, 7, 7};
  const auto crossed = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    tree.find_crossed(from, to, found);
    std::sort(found.begin(), found.end());
    return found;
  };
  using Found = std::vector<std::size_t>;
  EXPECT_EQ(crossed({1, 0.5, -1}, {1, 0.5, 5}), (Found{0, 2})) << "through the bottom and the top";
  EXPECT_EQ(crossed({1, 0.5, -1}, {1, 0.5, 1}), Found{0}) << "ends inside";
  EXPECT_EQ(crossed({1, 0.5, 1}, {1, 0.5, 3}), Found{}) << "wholly inside";
  EXPECT_EQ(crossed({1, 0.5, -3}, {1, 0.5, -1}), Found{}) << "ends before it";
  EXPECT_EQ(crossed({1, 0.5, -1}, {1, 0.5, 0}), Found{0}) << "touches it";
}

TEST(TriangleTree, OfACopyAnswersTheSame) {
  std::vector<Triangle> triangles = triangles_of(test::box({0, 0, 0}, {4, 4, 4}));
  auto first = std::make_unique<TriangleTree>(triangles);
  const TriangleTree copy = *first;
  first.reset();
  triangles.clear();
  EXPECT_DOUBLE_EQ(copy.squared_distance({2, 2, 7}), 9);
}

}  // namespace brainshift::triangle_tree_test
