// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_distance.hpp"

#include <gtest/gtest.h>

#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::each_distance_test {

/// Inside, at the surface, and beyond the grid, which reaches 25 mm past the surface.
TEST(DistanceOfEach, IsThatAtEachPlace) {
  const SignedDistance distance(test::box(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(20)));
  for (const double reach : {20.0, 24.0, 140.0}) {
    const Points places = test::random_points(static_cast<int>(members), reach);
    VectorOfEach<double> each;
    for (std::size_t m = 0; m < members; ++m) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        each.of[axis][m] = places(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(axis));
      }
    }
    each.of[0][7] = -each.of[0][7];
    const NumberOfEach<double> found = distance_of_each(distance, each);
    const VectorOfEach<double> slope = gradient_of_each(distance, each);
    for (std::size_t m = 0; m < members; ++m) {
      const Eigen::Vector3d place(each.of[0][m], each.of[1][m], each.of[2][m]);
      EXPECT_NEAR(found.of[m], distance.value(place), 1e-12) << place.transpose();
      const Eigen::Vector3d expected = distance.gradient(place);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(slope.of[axis][m], expected[static_cast<Eigen::Index>(axis)], 1e-9);
      }
    }
  }
}

}  // namespace brainshift::solve::each_distance_test
