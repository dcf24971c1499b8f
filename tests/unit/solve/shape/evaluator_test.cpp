// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/evaluator.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/solve/cut_bodies.hpp"

namespace brainshift::solve::evaluator_test {

constexpr double side = 40;

std::vector<EvaluationPoint> some_points(int count, double of_side = side) {
  const Points at = test::random_points(count, of_side / 8);
  std::vector<EvaluationPoint> points;
  for (Eigen::Index i = 0; i < at.rows(); ++i) {
    points.push_back({at.row(i).transpose().array() + side / 3, static_cast<std::int32_t>(i)});
  }
  return points;
}

NodeSupports supports_of(const NodeCloud& cloud, const ShapeOptions& options,
                         std::shared_ptr<const Visibility> visibility = nullptr) {
  return {cloud.positions, cloud.spacing, options, std::move(visibility)};
}

TEST(Evaluator, BallHoldsItsPoints) {
  const std::vector<EvaluationPoint> points = some_points(40);
  const Ball ball = ball_about(points);
  double farthest = 0;
  for (const EvaluationPoint& p : points) {
    farthest = std::max(farthest, (p.at - ball.centre).norm());
  }
  EXPECT_GE(ball.extent, farthest);
  EXPECT_NEAR(ball.extent, farthest, 1e-6);
  EXPECT_LE(ball.extent, std::sqrt(3.0) / 2 * side / 8 + 1e-6) << "about the middle of their box";
}

TEST(Evaluator, CandidatesAreTheNodesWhoseSupportsReachTheBall) {
  const NodeCloud cloud = test::irregular_box(9, side);
  const NodeSupports supports = supports_of(cloud, {});
  const Ball ball{{15, 20, 18}, 4};
  const Candidates near = candidates_near(supports, ball, 1.2);
  std::vector<std::int32_t> expected;
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    const double distance = (cloud.positions.row(static_cast<Eigen::Index>(a)).transpose() - ball.centre).norm();
    if (distance < 1.2 * supports.search.radius()[a] + ball.extent) {
      expected.push_back(static_cast<std::int32_t>(a));
    }
  }
  EXPECT_EQ(near.node, expected);
  EXPECT_EQ(near.x.size(), near.node.size());
  EXPECT_EQ(near.y[3], cloud.positions(near.node[3], 1));
  EXPECT_EQ(near.radius[3], supports.search.radius()[static_cast<std::size_t>(near.node[3])]);
}

TEST(Evaluator, FindsTheShapeFunctionsOfFewerPointsThanLanes) {
  const NodeCloud cloud = test::irregular_box(9, side);
  const NodeSupports supports = supports_of(cloud, {.basis = Basis::linear, .dilatation = 2});
  const std::vector<EvaluationPoint> points = some_points(5);
  Evaluator evaluator(supports, 8);
  int calls = 0;
  const int bad = evaluator.move_to(points, candidates_near(supports, ball_about(points), 1), [&](const Mask& found) {
    ++calls;
    EXPECT_FALSE(evaluator.grown());
    const std::span<const ShapeGradient> gradients = evaluator.gradients();
    for (int l = 0; l < lanes; ++l) {
      ASSERT_EQ(found[l] != 0, l < 5);
      double sum = 0, slope = 0;
      std::int64_t seen = 0;
      for (std::size_t a = 0; l < 5 && a < evaluator.neighbours().size(); ++a) {
        sum += evaluator.neighbours()[a].value[l];
        slope += gradients[a].axis[1][l];
        seen += evaluator.neighbours()[a].supports(l) ? 1 : 0;
      }
      if (l < 5) {
        EXPECT_NEAR(sum, 1, 1e-12);
        EXPECT_NEAR(slope, 0, 1e-12);
        EXPECT_EQ(evaluator.support_size(l), seen);
      }
    }
  });
  EXPECT_EQ(bad, -1);
  EXPECT_EQ(calls, 1);
}

TEST(Evaluator, GrowsSupportsThatAreTooSmallUntilEachPointHasOne) {
  const NodeCloud cloud = test::irregular_box(9, side);
  const NodeSupports supports = supports_of(cloud, {.basis = Basis::linear, .dilatation = 0.8});
  const std::vector<EvaluationPoint> points = some_points(lanes);
  Evaluator evaluator(supports, 8);
  int times_found[lanes] = {}, grown = 0;
  const int bad = evaluator.move_to(points, candidates_near(supports, ball_about(points), 1), [&](const Mask& found) {
    grown += evaluator.grown() ? 1 : 0;
    for (int l = 0; l < lanes; ++l) {
      times_found[l] += found[l] != 0 ? 1 : 0;
    }
  });
  EXPECT_EQ(bad, -1);
  EXPECT_GT(grown, 0);
  EXPECT_EQ(std::count(std::begin(times_found), std::end(times_found), 1), lanes);
}

TEST(Evaluator, NamesALaneForWhichThereIsNoSupport) {
  NodeCloud flat = test::irregular_box(4, side);
  flat.positions.col(2).setConstant(side / 3);
  const NodeSupports supports = supports_of(flat, {.basis = Basis::linear});
  const std::vector<EvaluationPoint> points = some_points(3);
  Evaluator evaluator(supports, 8);
  const int bad = evaluator.move_to(points, candidates_near(supports, ball_about(points), 1),
                                    [](const Mask&) { FAIL() << "a basis of space from nodes in a plane"; });
  EXPECT_EQ(bad, 0);
}

TEST(Evaluator, DoesNotSeeThroughACut) {
  const NodeCloud cloud = test::irregular_rectangle(15, 15, side, side);
  const auto cut = std::make_shared<const Visibility>(test::path({{-1, 17}, {41, 17}}, false));
  const NodeSupports supports = supports_of(cloud, {.basis = Basis::linear, .planar = true}, cut);
  std::vector<EvaluationPoint> points;
  for (int i = 0; i < lanes; ++i) {
    points.push_back({Eigen::Vector3d(10 + i, i % 2 == 0 ? 16 : 18, 0), i});
  }
  Evaluator evaluator(supports, 8);
  const int bad = evaluator.move_to(points, candidates_near(supports, ball_about(points), 1), [&](const Mask& found) {
    for (int l = 0; l < lanes; ++l) {
      for (const Neighbour& s : evaluator.neighbours()) {
        if (found[l] != 0 && s.supports(l)) {
          ASSERT_EQ(cloud.positions(s.node, 1) < 17, l % 2 == 0) << "on its own side";
        }
      }
    }
  });
  EXPECT_EQ(bad, -1);
}

}  // namespace brainshift::solve::evaluator_test
