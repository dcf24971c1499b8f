// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/solution_file.hpp"

#include <gtest/gtest.h>
#include <vtkPointData.h>

#include <cmath>

#include "segmentation/files/vtu_file.hpp"
#include "solve/interface/solution.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solution_file_test {

Solution planar_solution() {
  const NodeCloud cloud = test::irregular_rectangle(7, 6, 60, 50);
  Solution solution{.positions = cloud.positions,
                    .displacement = cloud.positions * 0.1,
                    .reaction_force = Points::Zero(cloud.positions.rows(), 3),
                    .spacing = cloud.spacing,
                    .shape = {}};
  solution.shape.planar = true;
  return solution;
}

Solution read_back(const Solution& solution) {
  const test::ScratchFolder folder;
  const auto file = folder / "solution.vtu";
  write_solution(file, solution);
  return read_solution(file);
}

std::string refusal(const Solution& solution) {
  return test::refusal([&] { read_back(solution); });
}

TEST(Solution, SurvivesWritingAndReading) {
  const NodeCloud cloud = test::irregular_box(5, 60);
  Solution solution{.positions = cloud.positions,
                    .displacement = test::random_points(125, 3, 1),
                    .reaction_force = test::random_points(125, 1, 2),
                    .spacing = cloud.spacing,
                    .shape = {.basis = Basis::linear, .dilatation = 1.7},
                    .estimated_error = std::vector<double>(125, 0.25)};
  const Solution read = read_back(solution);
  EXPECT_EQ(read.positions, solution.positions);
  EXPECT_EQ(read.displacement, solution.displacement);
  EXPECT_EQ(read.reaction_force, solution.reaction_force);
  EXPECT_EQ(read.estimated_error, solution.estimated_error);
  EXPECT_EQ(read.spacing, solution.spacing);
  EXPECT_EQ(read.shape.basis, Basis::linear);
  EXPECT_EQ(read.shape.dilatation, 1.7);
  EXPECT_FALSE(read.shape.planar);
}

TEST(Solution, WithNumbersThatNoSolveWritesIsRefused) {
  const NodeCloud cloud = test::irregular_box(5, 60);
  const Solution good{.positions = cloud.positions,
                      .displacement = test::random_points(125, 3, 1),
                      .reaction_force = test::random_points(125, 1, 2),
                      .spacing = cloud.spacing,
                      .shape = {.basis = Basis::linear, .dilatation = 1.7}};
  EXPECT_EQ(refusal(good), "");
  for (const double moved : {1.1e4, 1e30, 1e300}) {
    Solution solution = good;
    solution.displacement(7, 1) = moved;
    EXPECT_NE(refusal(solution).find("displacement of node 7 is"), std::string::npos) << refusal(solution);
  }
  for (const double number : {-1.0, -1e30, 11.0, std::nan("")}) {
    Solution solution = good;
    solution.shape.dilatation = number;
    EXPECT_NE(refusal(solution).find("shape_dilatation is "), std::string::npos) << refusal(solution);
    solution = good;
    solution.shape.penalty = number;
    EXPECT_NE(refusal(solution).find("shape_penalty is "), std::string::npos) << refusal(solution);
  }
}

TEST(PlanarSolution, GivesItsFieldBackAfterWritingAndReading) {
  const Solution solution = planar_solution();
  const Solution read = read_back(solution);
  EXPECT_TRUE(read.shape.planar);
  EXPECT_EQ(read.displacement, solution.displacement);
  Points at = test::random_points(40, 50);
  at.col(2).setZero();
  const solve::ShapeFunctions shape(read.positions, read.spacing, read.shape);
  EXPECT_LE((shape.interpolate(at, read.displacement) - 0.1 * at).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PlanarSolution, IsOneOnlyWhereTheFileSaysSo) {
  Solution solution = planar_solution();
  solution.shape.planar = false;
  EXPECT_FALSE(read_back(solution).shape.planar);
  const test::ScratchFolder folder;
  const auto file = folder / "foreign.vtu";
  const auto grid = vtu::vertex_grid(solution.positions);
  const Points& u = solution.displacement;
  vtu::add_array(*grid->GetPointData(), "displacement", {u.data(), static_cast<std::size_t>(u.size())}, 3);
  vtu::write(file, *grid);
  EXPECT_FALSE(read_solution(file).shape.planar);
}

TEST(PlanarSolution, OffThePlaneIsRefusedWithTheNode) {
  Solution solution = planar_solution();
  solution.positions(8, 2) = 0.5;
  EXPECT_NE(refusal(solution).find("node 8 has z = 0.5 mm"), std::string::npos) << refusal(solution);
}

TEST(PlanarSolution, NeedsThreeNodes) {
  Solution solution = planar_solution();
  for (Points* points : {&solution.positions, &solution.displacement, &solution.reaction_force}) {
    points->conservativeResize(3, 3);
  }
  solution.spacing.resize(3);
  EXPECT_EQ(read_back(solution).positions, solution.positions);
  solution.shape.planar = false;
  EXPECT_NE(refusal(solution).find("at least 4 nodes"), std::string::npos);
}

}  // namespace brainshift::solution_file_test
