// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/face_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "solve/quadrature/cell_points.hpp"
#include "tests/unit/solve/cut_bodies.hpp"

namespace brainshift::solve::face_nodes_test {

constexpr double side = 20, spacing = 2;

/// An even square of nodes, cut along a path.
struct Cutting {
  NodeCloud cloud = test::irregular_rectangle(11, 11, side, side, 0);
  Conditions conditions = test::all_free(cloud);
  std::vector<FacePair> pairs = {};
  std::size_t split = 0;

  void along(const std::vector<std::pair<double, double>>& corners, bool tip) {
    const IntegrationPoints points = integration_points(test::rectangle_cells(10, 10, side, side), 4, nullptr, {1});
    const InsideBody inside(points.positions, points.volume, true);
    split = add_face_nodes(test::path(corners, tip), inside, cloud, conditions, pairs);
  }
  Eigen::RowVector3d place(std::int32_t node) const { return cloud.positions.row(node); }
};

TEST(FaceNodes, SplitTheNodesOnTheCut) {
  Cutting body;
  body.along({{-2, 10}, {22, 10}}, false);  // through a row of 11 nodes
  EXPECT_EQ(body.split, 11U);
  EXPECT_EQ(body.pairs.size(), 11U) << "none between: they are a spacing apart";
  EXPECT_EQ(body.cloud.size(), 132U);
  for (const FacePair& p : body.pairs) {
    EXPECT_LT(p.above, 121);
    EXPECT_GE(p.below, 121);
    EXPECT_NEAR(p.place.y(), 10, 1e-12);
    EXPECT_LE((p.normal - Eigen::Vector3d::UnitY()).norm(), 1e-12) << "to the left of the path";
    EXPECT_LE((body.place(p.above) - p.place.transpose() - Eigen::RowVector3d(0, 1e-3 * spacing, 0)).norm(), 1e-12);
    EXPECT_LE((body.place(p.below) - p.place.transpose() + Eigen::RowVector3d(0, 1e-3 * spacing, 0)).norm(), 1e-12);
    EXPECT_EQ(body.cloud.on_surface[static_cast<std::size_t>(p.below)], 1);
    EXPECT_EQ(body.cloud.spacing[static_cast<std::size_t>(p.below)], spacing);
  }
}

TEST(FaceNodes, AreAddedInPairsWhereThereIsNoNodeNear) {
  Cutting body;
  const Points before = body.cloud.positions;
  body.along({{-2, 11}, {22, 11}}, false);  // amid two rows
  EXPECT_EQ(body.cloud.size(), 121 + 2 * body.pairs.size() - body.split);
  EXPECT_EQ(body.split, 0U + static_cast<std::size_t>(std::count_if(body.pairs.begin(), body.pairs.end(),
                                                                    [](const FacePair& p) { return p.above < 121; })));
  std::vector<double> along;
  for (const FacePair& p : body.pairs) {
    along.push_back(p.place.x());
  }
  std::sort(along.begin(), along.end());
  EXPECT_LE(along.front(), 1e-6) << "the mouths have nodes of their own";
  EXPECT_GE(along.back(), side - 1e-6);
  for (std::size_t i = 1; i < along.size(); ++i) {
    EXPECT_LT((along[i] - along[i - 1]) / 2, 0.91 * spacing) << "how far a place between them is from one";
  }
  std::size_t moved = 0;
  for (Eigen::Index a = 0; a < before.rows(); ++a) {
    moved += before.row(a) != body.cloud.positions.row(a) ? 1 : 0;
  }
  EXPECT_EQ(moved, body.split) << "others stay where they are";
}

TEST(FaceNodes, StayClearOfTheTipUntilItHasPassed) {
  Cutting body;
  body.along({{-2, 10}, {10.5, 10}}, true);
  for (const FacePair& p : body.pairs) {
    EXPECT_LE(p.place.x(), 10.5 - spacing / 2);
  }
  const std::size_t first = body.pairs.size();
  body.along({{-2, 10}, {22, 10}}, false);
  EXPECT_EQ(body.pairs.size(), 11U) << "those there already are not made again";
  EXPECT_EQ(first + body.split, 11U) << "the others are split now";
}

TEST(FaceNodes, AreHeldAsTheNodeWasAndShareItsForce) {
  Cutting body;
  body.conditions.displacement.row(60) << 1, std::nan(""), -2;  // amid the square
  body.conditions.force = Points::Constant(121, 3, 0.25);
  body.along({{-2, 10}, {22, 10}}, false);
  EXPECT_EQ(body.conditions.displacement.rows(), 132);
  EXPECT_NEAR(body.conditions.force.sum(), 121 * 3 * 0.25, 1e-12);
  for (const FacePair& p : body.pairs) {
    EXPECT_EQ(body.conditions.force.row(p.above), Eigen::RowVector3d::Constant(0.125));
    EXPECT_EQ(body.conditions.is_prescribed(p.below), p.above == 60);
  }
  const auto of_held =
      std::find_if(body.pairs.begin(), body.pairs.end(), [](const FacePair& p) { return p.above == 60; });
  ASSERT_NE(of_held, body.pairs.end());
  EXPECT_EQ(body.conditions.displacement(of_held->below, 0), 1);
  EXPECT_TRUE(std::isnan(body.conditions.displacement(of_held->below, 1)));
}

TEST(FaceNodes, ThatMoveTakeWhatIsPrescribedWhereTheyComeToLie) {
  Cutting body;
  const auto prescribed = [](const Eigen::RowVector3d& x) { return 0.3 * x.x() - 0.1 * x.y(); };
  for (Eigen::Index a = 0; a < 121; ++a) {
    body.conditions.displacement(a, 0) = prescribed(body.cloud.positions.row(a));
  }
  body.along({{-2, 10.4}, {22, 10.4}}, false);
  EXPECT_GT(body.split, 0U);
  for (const FacePair& p : body.pairs) {
    if (p.above < 121) {
      EXPECT_NEAR(body.conditions.displacement(p.above, 0), prescribed(p.place.transpose()), 1e-9);
      EXPECT_EQ(body.conditions.displacement(p.below, 0), body.conditions.displacement(p.above, 0));
    }
  }
}

TEST(FaceNodes, OfACutOutsideTheBodyAreNone) {
  Cutting body;
  body.along({{-9, 40}, {30, 40}}, false);
  EXPECT_TRUE(body.pairs.empty());
  EXPECT_EQ(body.cloud.size(), 121U);
}

TEST(FaceNodes, OfASheetCoverBothItsFaces) {
  NodeCloud cloud = test::irregular_box(7, 18, 0.2);
  Conditions conditions = test::all_free(cloud);
  cloud.positions.rowwise() -= Eigen::RowVector3d(0, 9, 9);
  BackgroundCells cells = test::box_cells(6, 18);
  cells.vertices.rowwise() -= Eigen::RowVector3d(0, 9, 9);
  const IntegrationPoints points = integration_points(cells, 8, nullptr, {1});
  std::vector<FacePair> pairs;
  add_face_nodes(test::sheet_along_x(18), InsideBody(points.positions, points.volume, false), cloud, conditions, pairs);
  for (const FacePair& p : pairs) {
    EXPECT_NEAR(p.place.y(), 0, 1e-9);
    EXPECT_GT(p.normal.dot(cloud.positions.row(p.above) - cloud.positions.row(p.below)), 0);
    EXPECT_LE(p.place.x(), 18 - 3 / 2.0 + 1e-9) << "half a spacing from the front";
  }
  double widest = 0;
  const Points places = test::random_points(300, 1);
  for (const auto& x : places.rowwise()) {
    const Eigen::Vector3d on_sheet(16 * x[0], 0, 18 * x[1] - 9);
    double nearest = 1e9;
    for (const FacePair& p : pairs) {
      nearest = std::min(nearest, (p.place - on_sheet).norm());
    }
    widest = std::max(widest, nearest);
  }
  EXPECT_LT(widest, 3) << "a spacing from any place of it there is a pair";
}

/// A sheet between two layers of nodes, one face of the box held, each side of the sheet by a motion of its own.
TEST(FaceNodes, WithinAHeldPatchAreHeldAsTheirSideOfIt) {
  const Eigen::RowVector3d to_middle(0, 9 + 1.5, 9);
  NodeCloud cloud = test::irregular_box(7, 18, 0.1);
  Conditions conditions = test::all_free(cloud);
  cloud.positions.rowwise() -= to_middle;
  BackgroundCells cells = test::box_cells(6, 18);
  cells.vertices.rowwise() -= to_middle;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = cloud.positions.row(a);
    if (x.z() > 9 - 1e-9) {
      conditions.displacement.row(a) << 0.1 * x.x(), (x.y() > 0 ? 1 : -2), 0.2 * x.y() - 3;
    }
  }
  const IntegrationPoints points = integration_points(cells, 8, nullptr, {1});
  std::vector<FacePair> pairs;
  const auto before = static_cast<std::int32_t>(cloud.size());
  add_face_nodes(test::sheet_along_x(18), InsideBody(points.positions, points.volume, false), cloud, conditions, pairs);
  std::size_t on_patch = 0, inside = 0;
  for (const FacePair& p : pairs) {
    if (p.above < before) {
      continue;  // split
    }
    if (p.place.z() > 9 - 1) {
      ++on_patch;
      for (const std::int32_t node : {p.above, p.below}) {
        const bool positive = cloud.positions(node, 1) > 0;
        const Eigen::RowVector3d expected(0.1 * p.place.x(), positive ? 1 : -2, -3);
        EXPECT_LT((conditions.displacement.row(node) - expected).norm(), 1e-9) << p.place.transpose();
      }
    } else if (p.place.z() < 9 - 3) {
      ++inside;
      EXPECT_FALSE(conditions.is_prescribed(p.above) || conditions.is_prescribed(p.below));
    }
  }
  EXPECT_GT(on_patch, 3U);
  EXPECT_GT(inside, 10U);
}

}  // namespace brainshift::solve::face_nodes_test
