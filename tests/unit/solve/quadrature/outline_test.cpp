// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::outline_test {

constexpr double width = 60, height = 40;
constexpr int nx = 13, ny = 9;

TEST(Outline, GoesThroughAllSurfaceNodesOfARectangle) {
  const NodeCloud cloud = test::irregular_rectangle(nx, ny, width, height);
  const auto edges = outline(cloud, test::rectangle_cells(6, 5, width, height));
  EXPECT_EQ(edges.size(), static_cast<std::size_t>(std::ranges::count(cloud.on_surface, 1)));
  EXPECT_TRUE(is_within(cloud.positions, edges, {0.1, 39.9, 0}));
  for (const Eigen::Vector3d& x : {Eigen::Vector3d(-0.1, 20, 0), Eigen::Vector3d(60.1, 20, 0),
                                   Eigen::Vector3d(30, 40.1, 0), Eigen::Vector3d(30, -0.1, 0)}) {
    EXPECT_FALSE(is_within(cloud.positions, edges, x));
  }
}

TEST(Outline, OfABodyWithAHoleLeavesTheHoleOut) {
  NodeCloud cloud = test::irregular_rectangle(nx, ny, width, height, 0);
  const auto in_hole = [](const Eigen::RowVector3d& x) { return x[0] > 16 && x[0] < 44 && x[1] > 11 && x[1] < 29; };
  std::vector<std::int32_t> kept;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = cloud.positions.row(a);
    if (!in_hole(x)) {
      kept.push_back(static_cast<std::int32_t>(a));
      const bool at_hole = x[0] > 14 && x[0] < 46 && x[1] > 9 && x[1] < 31;
      cloud.on_surface[static_cast<std::size_t>(a)] |= at_hole ? 1 : 0;
    }
  }
  const NodeCloud ring = subset(cloud, kept);
  BackgroundCells cells = test::rectangle_cells(12, 8, width, height);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const Eigen::RowVector3d low = cells.vertices.row(cells.connectivity[4 * cell]);
    const bool hole = low[0] > 14 && low[0] < 44 && low[1] > 9 && low[1] < 29;
    cells.inside_fraction[cell] = hole ? 1e-9 : 1;
  }
  const auto edges = outline(ring, cells);
  EXPECT_FALSE(is_within(ring.positions, edges, {30.3, 20.2, 0}));
  EXPECT_TRUE(is_within(ring.positions, edges, {7.2, 20.2, 0}));
}

TEST(Outline, IsNoneWhereItIsOpenOrNotThatOfTheCells) {
  NodeCloud cloud = test::irregular_rectangle(nx, ny, width, height);
  EXPECT_TRUE(outline(cloud, test::rectangle_cells(6, 5, 1.1 * width, height)).empty());
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    if (cloud.positions(a, 1) > height - 1e-9) {
      cloud.on_surface[static_cast<std::size_t>(a)] = 0;
    }
  }
  EXPECT_TRUE(outline(cloud, test::rectangle_cells(6, 5, width, height)).empty());
}

/// Cells that the body's sides cut, which say how much of them is inside and no more: pressed between frictionless
/// plates, plane stress, the answer is known.
TEST(Outline, MakesHomogeneousStatesExactOnCellsThatDoNotConform) {
  constexpr double side = 7, start = -3;
  constexpr int columns = 9, rows = 7;
  Model model;
  model.cloud = test::irregular_rectangle(nx, ny, width, height);
  model.conditions = test::all_free(model.cloud);
  model.plane = Plane::stress;
  model.materials[1] = {3000, 0.3, 1000};
  model.cells = test::rectangle_cells(columns, rows, columns * side, rows * side);
  model.cells.vertices.leftCols<2>().array() += start;
  const auto inside = [](double low, double end) { return std::min(low + side, end) - std::max(low, 0.0); };
  for (std::size_t cell = 0; cell < model.cells.size(); ++cell) {
    const Eigen::RowVector3d low = model.cells.vertices.row(model.cells.connectivity[4 * cell]);
    model.cells.inside_fraction[cell] = inside(low[0], width) * inside(low[1], height) / (side * side);
  }
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    auto u = model.conditions.displacement.row(a);
    u[0] = x[0] < 1e-9 ? 0 : u[0];
    u[1] = x[1] < 1e-9 ? 0 : x[1] > height - 1e-9 ? -0.2 * height : u[1];
  }
  SolveOptions options;
  options.tolerance = 1e-3;
  const SolveResult result = solve(model, options);
  ASSERT_EQ(result.failure, "");
  const Points& u = result.solution.displacement;
  EXPECT_LT((u.col(1) + 0.2 * model.cloud.positions.col(1)).cwiseAbs().maxCoeff(), 2e-3);
  const double wider = u.col(0).maxCoeff() / width;
  EXPECT_LT((u.col(0) - wider * model.cloud.positions.col(0)).cwiseAbs().maxCoeff(), 2e-3);
}

}  // namespace brainshift::solve::outline_test
