// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/make_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "tests/unit/discretise/bodies.hpp"

namespace brainshift::discretise::make_cloud_test {

const Eigen::Vector3d centre(30, -210, 55);
constexpr double radius = 40;

MadeCloud made(const DiscretiseOptions& options, const Progress& progress = {}) {
  const Surface surface = test::ball(radius, centre, 4);
  const Scanlines body(surface);
  return make_cloud(surface, body, nullptr, {}, node_demand(surface, {}, body, nullptr, options), options, progress);
}

/// Distance of each node to its nearest, by looking at all pairs.
std::vector<double> nearest_by_all_pairs(const Points& nodes) {
  std::vector<double> nearest(static_cast<std::size_t>(nodes.rows()), std::numeric_limits<double>::infinity());
  for (Eigen::Index a = 0; a < nodes.rows(); ++a) {
    for (Eigen::Index b = 0; b < nodes.rows(); ++b) {
      if (a != b) {
        double& least = nearest[static_cast<std::size_t>(a)];
        least = std::min(least, (nodes.row(a) - nodes.row(b)).norm());
      }
    }
  }
  return nearest;
}

/// Least over nodes of distance to the nearest node / local spacing.
double smallest_ratio(const NodeCloud& cloud) {
  const std::vector<double> nearest = nearest_by_all_pairs(cloud.positions);
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t node = 0; node < nearest.size(); ++node) {
    smallest = std::min(smallest, nearest[node] / cloud.spacing[node]);
  }
  return smallest;
}

TEST(MakeCloud, KeepsNodesAsFarApartAsAskedAndSaysHowFar) {
  for (const double least : {0.5, 0.7}) {
    const MadeCloud result = made({.nodes = 2000, .minimum_distance = least});
    EXPECT_GE(result.smallest_distance_ratio, least);
    EXPECT_NEAR(result.smallest_distance_ratio, smallest_ratio(result.cloud), 1e-12);
    EXPECT_NEAR(static_cast<double>(result.cloud.size()), 2000, 100);
  }
}

TEST(MakeCloud, CountsTheNodesThatItTookOut) {
  for (const double least : {0.0, 0.7}) {
    const MadeCloud result = made({.nodes = 1500, .minimum_distance = least});
    EXPECT_EQ(result.cloud.size() + result.removed_nodes, 1500U);
    EXPECT_EQ(result.removed_nodes > 0, least > 0);
  }
}

TEST(MakeCloud, SaysTheSpacingThatTheNodesHave) {
  const NodeCloud cloud = made({.nodes = 2000}).cloud;
  const Points& x = cloud.positions;
  for (Eigen::Index node = 0; node < x.rows(); node += 7) {
    std::vector<double> distances;
    for (Eigen::Index other = 0; other < x.rows(); ++other) {
      distances.push_back((x.row(node) - x.row(other)).norm());
    }
    std::sort(distances.begin(), distances.end());
    const double six_nearest = std::accumulate(distances.begin() + 1, distances.begin() + 7, 0.0) / 6;
    EXPECT_NEAR(cloud.spacing[static_cast<std::size_t>(node)], six_nearest, 0.25 * six_nearest);
  }
}

TEST(MakeCloud, FlagsTheNodesOnTheSurface) {
  const NodeCloud cloud = made({.nodes = 1500}).cloud;
  ASSERT_EQ(cloud.on_surface.size(), cloud.size());
  for (std::size_t node = 0; node < cloud.size(); ++node) {
    const double depth = radius - (cloud.positions.row(static_cast<Eigen::Index>(node)) - centre.transpose()).norm();
    EXPECT_EQ(cloud.on_surface[node] != 0, depth < 0.15 * cloud.spacing[node]) << depth;
  }
}

TEST(MakeCloud, OrdersNeighboursOneAfterTheOther) {
  const NodeCloud cloud = made({.nodes = 2000}).cloud;
  double way = 0;
  for (Eigen::Index node = 1; node < cloud.positions.rows(); ++node) {
    way += (cloud.positions.row(node) - cloud.positions.row(node - 1)).norm();
  }
  const double spacing = std::accumulate(cloud.spacing.begin(), cloud.spacing.end(), 0.0) / 2000;
  EXPECT_LT(way / 2000, 1.6 * spacing);
}

TEST(MakeCloud, IsTheSameForTheSameSeedAloneAndTellsItsProgress) {
  std::vector<double> told;
  const auto tell = [&](double fraction, std::string_view) { told.push_back(fraction); };
  const Points first = made({.nodes = 400}, tell).cloud.positions;
  EXPECT_EQ(first, made({.nodes = 400}).cloud.positions);
  EXPECT_NE(first, made({.nodes = 400, .seed = 2}).cloud.positions);
  EXPECT_GE(told.size(), 2U);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
}

}  // namespace brainshift::discretise::make_cloud_test
