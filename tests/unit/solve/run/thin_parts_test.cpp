// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/thin_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solve/solve.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::thin_parts_test {

/// A cube of 6³ nodes, 12 mm apart, whose lower 24 mm are of another tissue, with a disc on its top moved.
Model layered(double radius) {
  Model model = uniaxial(1, 6);
  test::label_cells(model.cells, [](const Eigen::RowVector3d& low) { return low[2] < 23 ? 2 : 1; });
  model.materials[2] = {3000, 0.3, 1000};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    model.conditions.displacement.row(a).setConstant(x[2] < 1e-9 ? 0 : std::nan(""));
    if (x[2] > model_side - 1e-9 && std::hypot(x[0] - 30, x[1] - 30) < radius) {
      model.conditions.displacement.row(a) << 0, 0, -2;
    }
  }
  return model;
}

TEST(ThinParts, AreNamedWhereNothingTellsTheErrorForWantOfNodes) {
  const SolveResult result = solve(layered(15), {});
  ASSERT_EQ(result.failure, "");
  const std::vector<ThinPart>& thin = result.measures.thin;
  ASSERT_EQ(thin.size(), 3U);
  EXPECT_EQ(thin[0].what, "the moved patch");
  EXPECT_NEAR(thin[0].spacings, 1, 0.1) << "four nodes, two in a row";
  EXPECT_EQ(thin[1].what, "tissue 1");
  EXPECT_NEAR(thin[1].spacings, 3, 0.5);
  EXPECT_EQ(thin[2].what, "tissue 2");
  EXPECT_NEAR(thin[2].spacings, 2, 0.5);
}

/// A body that hangs by a few nodes: the estimate of the error does not know how little these resolve.
TEST(ThinParts, AreWhatABodyHangsBy) {
  Model model = box_model(test::box_cells(8, model_side), 9);
  model.gravity = {0, 0, -1};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    if (x[2] > model_side - 1e-9 && std::hypot(x[0] - 30, x[1] - 30) < 12) {
      model.conditions.displacement.row(a).setZero();
    }
  }
  SolveOptions options;
  options.start = Start::coarse;
  options.shape.basis = Basis::linear;
  const SolveResult result = solve(model, options);
  ASSERT_EQ(result.failure, "");
  ASSERT_EQ(result.measures.thin.size(), 1U);
  EXPECT_EQ(result.measures.thin.front().what, "the held patch");
  EXPECT_LT(result.measures.thin.front().spacings, 3);
  EXPECT_TRUE(result.measures.estimated_error_95);
}

/// It ends with a force several times too high.
TEST(ThinParts, AreABodyOfEightNodes) {
  Model model = box_model(test::box_cells(1, model_side), 2);
  model.conditions.displacement = model.cloud.positions * Eigen::Vector3d(0, 0, -0.1).asDiagonal();
  SolveOptions options;
  options.shape.basis = Basis::linear;
  const SolveResult result = solve(model, options);
  ASSERT_EQ(result.failure, "");
  ASSERT_FALSE(result.measures.thin.empty());
  EXPECT_LE(result.measures.thin.back().spacings, 1);
}

TEST(ThinParts, AreNoneOfAWidePatchAndAThickBody) {
  const SolveResult result = solve(uniaxial(0.9, 7), {});
  ASSERT_EQ(result.failure, "");
  EXPECT_TRUE(result.measures.thin.empty());
}

}  // namespace brainshift::solve::thin_parts_test
