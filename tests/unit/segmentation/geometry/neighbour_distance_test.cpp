// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/neighbour_distance.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>

namespace brainshift::neighbour_distance_test {

/// Distances of a point to all others, nearest first.
std::vector<double> distances_from(const Points& points, Eigen::Index from) {
  std::vector<double> all;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (i != from) {
      all.push_back((points.row(i) - points.row(from)).norm());
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(NearestNeighbours, AreThoseThatLookingAtAllPairsFinds) {
  const Points points = 50 * Points::Random(300, 3);
  constexpr int count = 7;
  const NearestNeighbours found = nearest_neighbours(points, count);
  ASSERT_EQ(found.count, count);
  ASSERT_EQ(found.index.size(), 300U * count);
  for (Eigen::Index row = 0; row < points.rows(); ++row) {
    const std::vector<double> expected = distances_from(points, row);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t slot = static_cast<std::size_t>(row) * count + k;
      EXPECT_NE(found.index[slot], row);
      EXPECT_NEAR(found.distance[slot], expected[k], 1e-12);
      EXPECT_NEAR((points.row(found.index[slot]) - points.row(row)).norm(), expected[k], 1e-12);
    }
  }
}

TEST(NearestNeighbours, OfPointsThatCoincideAreAtNoDistanceAndNotThePointItself) {
  Points points(4, 3);
  points << 1, 2, 3, 1, 2, 3, 1, 2, 3, 5, 2, 3;
  const NearestNeighbours found = nearest_neighbours(points, 2);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t slot = 2 * row; slot < 2 * row + 2; ++slot) {
      EXPECT_EQ(found.distance[slot], 0.0);
      EXPECT_NE(found.index[slot], static_cast<std::int32_t>(row));
      EXPECT_NE(found.index[slot], 3);
    }
    EXPECT_NE(found.index[2 * row], found.index[2 * row + 1]);
  }
  EXPECT_EQ(found.distance[6], 4.0);
}

TEST(NearestNeighbours, AreFewerWhereThereAreNotThatMany) {
  EXPECT_EQ(nearest_neighbours(Points::Random(4, 3), 6).count, 3);
  EXPECT_EQ(nearest_neighbours(Points::Zero(1, 3), 6).count, 0);
  EXPECT_EQ(nearest_neighbours(Points(0, 3), 6).count, 0);
  EXPECT_TRUE(mean_neighbour_distance(nearest_neighbours(Points::Zero(1, 3), 6)).empty());
}

TEST(NearestNeighbours, DoNotDependOnTheNumberOfThreads) {
  const Points points = Points::Random(1000, 3);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const NearestNeighbours one = nearest_neighbours(points, 6);
  omp_set_num_threads(3);
  const NearestNeighbours three = nearest_neighbours(points, 6);
  omp_set_num_threads(threads);
  EXPECT_EQ(one.index, three.index);
  EXPECT_EQ(one.distance, three.distance);
}

TEST(MeanNeighbourDistance, IsTheMeanOfTheNearestAskedFor) {
  Points points(4, 3);
  points << 0, 0, 0, 1, 0, 0, 3, 0, 0, 8, 0, 0;
  const NearestNeighbours found = nearest_neighbours(points, 3);
  EXPECT_EQ(mean_neighbour_distance(found, 1), (std::vector<double>{1, 1, 2, 5}));
  EXPECT_EQ(mean_neighbour_distance(found, 2), (std::vector<double>{2, 1.5, 2.5, 6}));
  EXPECT_EQ(mean_neighbour_distance(found, 9), mean_neighbour_distance(found, 3));
}

}  // namespace brainshift::neighbour_distance_test
