// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/smoothing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "discretise/cloud/dart_grid.hpp"
#include "discretise/cloud/delaunay.hpp"
#include "discretise/cloud/tetrahedron.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::discretise::smoothing_test {

const Surface body_surface = test::box({0, 0, 0}, {10, 10, 10});
const Scanlines body(body_surface);

/// The body's corners, then nodes at random inside.
Points cloud(Eigen::Index inside, std::uint64_t seed = 5) {
  Points nodes(8 + inside, 3);
  nodes.topRows(8) = body_surface.vertices;
  Random random(seed);
  for (Eigen::Index node = 8; node < nodes.rows(); ++node) {
    nodes.row(node) << 0.5 + 9 * random.uniform(), 0.5 + 9 * random.uniform(), 0.5 + 9 * random.uniform();
  }
  return nodes;
}

/// Slivers with a node from row `first` on.
int slivers(const Points& nodes, Eigen::Index first) {
  int count = 0;
  for (const auto& corners : delaunay_tetrahedra(nodes)) {
    const bool may_move = std::ranges::any_of(corners, [&](std::int32_t node) { return node >= first; });
    count += may_move && shape_quality(corners_of(nodes, corners)) < 0.12 ? 1 : 0;
  }
  return count;
}

/// The vertices of a ball's surface, then nodes inside it that keep their distance.
Points spread_cloud(const Surface& ball, const Scanlines& inside) {
  constexpr double distance = 1.3;
  DartGrid grid({-10, -10, -10}, {10, 10, 10}, distance);
  Points nodes = ball.vertices;
  for (const auto& vertex : ball.vertices.rowwise()) {
    grid.accept(vertex);
  }
  Random random(1);
  for (int dart = 0; dart < 10000; ++dart) {
    const Eigen::Vector3d x(20 * random.uniform() - 10, 20 * random.uniform() - 10, 20 * random.uniform() - 10);
    if (inside.inside(x) && grid.is_free(x, distance)) {
      grid.accept(x);
      nodes.conservativeResize(nodes.rows() + 1, 3);
      nodes.bottomRows(1) = x.transpose();
    }
  }
  return nodes;
}

TEST(Smoothing, BringsANodeToTheMiddleOfWhatSurroundsIt) {
  Points nodes = cloud(1);
  nodes.row(8) << 7, 2.5, 6;
  for (int sweep = 0; sweep < 60; ++sweep) {
    smooth(nodes, 8, body, SizingField());
  }
  EXPECT_LT((nodes.row(8) - Eigen::RowVector3d(5, 5, 5)).norm(), 1e-3);
}

TEST(Smoothing, LeavesTheNodesBeforeTheFirstAndAllInside) {
  const Points before = cloud(150);
  Points nodes = before;
  smooth(nodes, 50, body, SizingField());
  EXPECT_EQ(nodes.topRows(50), before.topRows(50));
  EXPECT_GT((nodes - before).bottomRows(100).norm(), 1);
  for (const auto& node : nodes.bottomRows(100).rowwise()) {
    EXPECT_TRUE(body.inside(node.transpose()));
  }
}

TEST(Smoothing, BringsNodesToWhereTheFieldAsksForThem) {
  const SizingField finer_below({0, 0, 0}, {10, 10, 10}, 1,
                                [](const Eigen::Vector3d& x) { return 0.3 + 0.07 * x.z(); });
  Points even = cloud(300), finer = even;
  for (int sweep = 0; sweep < 5; ++sweep) {
    smooth(even, 8, body, SizingField());
    smooth(finer, 8, body, finer_below);
  }
  EXPECT_LT(finer.col(2).mean(), even.col(2).mean() - 0.5);
}

TEST(Smoothing, LeavesFewerSliversAndShakingHardlyAny) {
  const Surface ball = test::sphere({0, 0, 0}, 10, 3);
  const Scanlines inside(ball);
  const Eigen::Index first = ball.vertices.rows();
  Points nodes = spread_cloud(ball, inside);
  const int at_first = slivers(nodes, first);
  for (int sweep = 0; sweep < 3; ++sweep) {
    smooth(nodes, first, inside, SizingField());
  }
  const int smoothed = slivers(nodes, first);
  EXPECT_LT(smoothed, at_first);
  Random random(3);
  for (int sweep = 0; sweep < 3; ++sweep) {
    shake_slivers(nodes, first, inside, random);
  }
  EXPECT_LT(slivers(nodes, first), 0.5 * smoothed);
  EXPECT_EQ(nodes.topRows(first), ball.vertices);
  for (const auto& node : nodes.bottomRows(nodes.rows() - first).rowwise()) {
    EXPECT_TRUE(inside.inside(node.transpose()));
  }
}

TEST(Smoothing, ShakingLeavesGoodTetrahedraAlone) {
  Points nodes = cloud(1);
  nodes.row(8) << 5, 5, 5;
  const Points before = nodes;
  ASSERT_EQ(slivers(nodes, 0), 0);
  Random random(3);
  shake_slivers(nodes, 0, body, random);
  EXPECT_EQ(nodes, before);
}

}  // namespace brainshift::discretise::smoothing_test
