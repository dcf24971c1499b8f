// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/check_discretisation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::check_discretisation_test {

using testing::HasSubstr;

constexpr int n = 7;  // nodes along a side

/// A cube pressed by a tenth, in n_cells³ cells of the side given.
Model pressed(int n_cells, double side = model_side) {
  Model model = uniaxial(0.9, n);
  model.cells = test::box_cells(n_cells, side);
  return model;
}

std::string refusal(const Model& model, std::optional<int> points_per_cell = {}) {
  SolveOptions options;
  options.points_per_cell = points_per_cell;
  return test::refusal([&] { solve(model, options); });
}

TEST(CheckDiscretisation, TakesOnePointANode) {
  EXPECT_EQ(refusal(pressed(4)), "");  // 512 points, 343 nodes
}

TEST(CheckDiscretisation, RefusesHalfAPointANode) {
  EXPECT_THAT(refusal(pressed(2)), HasSubstr("only 64 integration points for 343 nodes"));
  EXPECT_THAT(refusal(pressed(5), 1), HasSubstr("only 125 integration points for 343 nodes"));
  Model small = uniaxial(0.9, 5);
  small.cells = test::box_cells(4, model_side);
  EXPECT_THAT(refusal(small, 1), HasSubstr("only 64 integration points for 125 nodes"));
}

TEST(CheckDiscretisation, RefusesFewerThanTwoThirdsOfAPointANode) {
  EXPECT_THAT(refusal(pressed(6), 1), HasSubstr("only 216 integration points for 343 nodes"));
}

TEST(CheckDiscretisation, RefusesTooFewPointsInOnePlaceAlone) {
  Model model = pressed(8);
  const BackgroundCells all = std::exchange(model.cells, {});
  model.cells.vertices = all.vertices;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const auto corners = std::span(all.connectivity).subspan(8 * c, 8);
    const double farthest = all.vertices.row(corners[0]).maxCoeff();  // of the lowest vertex, from the box's corner
    if (farthest == 0 || farthest > 0.4 * model_side) {
      model.cells.connectivity.insert(model.cells.connectivity.end(), corners.begin(), corners.end());
      model.cells.inside_fraction.push_back(1);
      model.cells.label.push_back(1);
    }
  }
  EXPECT_THAT(refusal(model, 1), HasSubstr("give smaller background cells there"));
}

/// Of even nodes and cells, about the number of all; of nodes that are nearer to each other in the middle, fewer.
TEST(CheckDiscretisation, CountsPointsWhereTheyAreFewest) {
  Model model = uniaxial(0.95, 10);
  model.cloud = test::irregular_box(10, model_side, 0);
  model.cells = test::box_cells(12, model_side);
  SolveOptions options;
  options.points_per_cell = 1;
  const double even = solve(model, options).measures.fewest_points;
  EXPECT_GT(even, 1);
  EXPECT_LT(even, 2);
  for (double& x : model.cloud.positions.reshaped()) {
    const double s = 2 * x / model_side - 1;
    x = model_side / 2 * (1 + 0.8 * s + 0.2 * s * s * s);
  }
  EXPECT_LT(solve(model, options).measures.fewest_points, 0.7 * even);
}

TEST(CheckDiscretisation, RefusesCellsThatReachBeyondTheCloud) {
  EXPECT_THAT(refusal(pressed(8, 1.5 * model_side)), HasSubstr("the background cells reach beyond the node cloud"));
}

/// About the same middle: each corner is near a node.
TEST(CheckDiscretisation, RefusesCellsAThirdLargerThanTheCloud) {
  Model model = pressed(8, 1.3 * model_side);
  model.cells.vertices.array() -= 0.15 * model_side;
  EXPECT_THAT(refusal(model), HasSubstr("mm outside the box of all nodes"));
}

/// As of nodes in the middles of voxels.
TEST(CheckDiscretisation, TakesNodesHalfASpacingBelowTheSurface) {
  constexpr double spacing = model_side / (n - 1);
  Model model = uniaxial(0.95, n);
  model.cells = test::box_cells(n, n * spacing);
  model.cells.vertices.array() -= spacing / 2;
  EXPECT_EQ(refusal(model), "");
}

std::string cloud_refusal(const NodeCloud& cloud) {
  return test::refusal([&] { check_cloud(cloud); });
}

/// The first of the nodes with so many times their spacing.
NodeCloud with_spacing(NodeCloud cloud, double factor, double share = 1) {
  const auto some = static_cast<std::size_t>(share * static_cast<double>(cloud.size()));
  for (double& s : std::span(cloud.spacing).first(some)) {
    s *= factor;
  }
  return cloud;
}

TEST(CheckDiscretisation, RefusesASpacingThatIsNotTheNodes) {
  Model model = pressed(8);
  model.cloud = with_spacing(model.cloud, 0.1);
  EXPECT_THAT(refusal(model), HasSubstr("'spacing' does not fit its nodes: the nearest node is typically"));
  EXPECT_THAT(cloud_refusal(with_spacing(test::irregular_box(n, 60), 0.1, 0.25)), HasSubstr("of a tenth of the nodes"));
}

TEST(CheckDiscretisation, RefusesASpacingThatIsThreeTimesTooLarge) {
  const NodeCloud irregular = test::irregular_box(n, 60), regular = test::irregular_box(n, 60, 0);
  for (const NodeCloud& wrong : {with_spacing(irregular, 3), with_spacing(regular, 3), with_spacing(regular, 10)}) {
    EXPECT_THAT(cloud_refusal(wrong), HasSubstr("'spacing' does not fit its nodes: the six nearest"));
  }
  for (const NodeCloud& sound : {with_spacing(irregular, 2), with_spacing(regular, 2)}) {
    EXPECT_EQ(cloud_refusal(sound), "");
  }
}

/// The nearest node of each is 0.15 spacings away.
TEST(CheckDiscretisation, TakesLayersThatLieNearEachOther) {
  NodeCloud layers = test::irregular_box(n, 60, 0);
  layers.positions = layers.positions.topRows(3 * n * n).eval();
  layers.positions.col(2) *= 0.15;
  layers.spacing.resize(3 * n * n);
  EXPECT_EQ(cloud_refusal(layers), "");
}

/// 1 : 2.6, with the coarsest spacing for all.
TEST(CheckDiscretisation, TakesAGradedCloudWithOneSpacing) {
  NodeCloud graded = test::irregular_box(9, 60);
  for (double& x : graded.positions.reshaped()) {
    const double s = x / 60;
    x = 60 * s * (1 + 0.8 * s) / 1.8;
  }
  EXPECT_EQ(cloud_refusal(with_spacing(graded, 2.6 / 1.8)), "");
}

TEST(CheckDiscretisation, RefusesTwinsBelowATenthOfASpacing) {
  Model model = pressed(8);
  model.cloud.positions.row(100) =
      model.cloud.positions.row(101) + Eigen::RowVector3d(0.05 * model_side / (n - 1), 0, 0);
  EXPECT_THAT(refusal(model), HasSubstr("mm apart"));
}

}  // namespace brainshift::solve::check_discretisation_test
