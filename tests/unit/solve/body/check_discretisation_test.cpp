// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/check_discretisation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <span>
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

TEST(CheckDiscretisation, RefusesASpacingThatIsNotTheNodes) {
  Model model = pressed(8);
  for (double& s : model.cloud.spacing) {
    s *= 0.1;
  }
  EXPECT_THAT(refusal(model), HasSubstr("'spacing' does not fit its nodes"));
}

TEST(CheckDiscretisation, RefusesTwinsBelowATenthOfASpacing) {
  Model model = pressed(8);
  model.cloud.positions.row(100) =
      model.cloud.positions.row(101) + Eigen::RowVector3d(0.05 * model_side / (n - 1), 0, 0);
  EXPECT_THAT(refusal(model), HasSubstr("mm apart"));
}

}  // namespace brainshift::solve::check_discretisation_test
