// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "pipelines/report/slice_figures.hpp"
#include "tests/unit/pipelines/report/small_run.hpp"

namespace brainshift::pipelines::view_test {

using Eigen::Vector3d;

TEST(View, LooksThroughTheOpening) {
  const View view = make_view(small_run());
  EXPECT_EQ(view.opening.rows(), 13);
  EXPECT_TRUE(view.opening_centre.isApprox(Vector3d(0, 0, 20)));
  EXPECT_TRUE(view.inward.isApprox(-Vector3d::UnitZ(), 1e-9));
  EXPECT_EQ(view.opening_reach, 5);
  EXPECT_DOUBLE_EQ(view.slices[0].plane.corner.z(), 20 - depth_of_planes) << "the axial plane";
}

TEST(View, MovesTheSurfaceAndScalesTheColoursToIt) {
  const View view = make_view(small_run());
  EXPECT_NEAR(view.deformed.vertices.col(2).maxCoeff(), 20, 1e-9);
  EXPECT_NEAR(*std::ranges::max_element(view.surface_shift), 4, 1e-6);
  EXPECT_EQ(view.shift.high, 4);
}

TEST(View, TheBrainSetsTheGreys) {
  const View view = make_view(small_run());
  EXPECT_EQ(view.darkest, 0) << "black is zero where nothing is below";
  EXPECT_GT(view.brightest, 20);
  EXPECT_LT(view.brightest, 1.15 * 30);
}

TEST(View, ALoadAllAroundIsNoOpening) {
  RunData run = small_run();
  const Points& vertices = run.brain->vertices;
  run.solution->positions = vertices;
  run.solution->displacement = Points::Constant(vertices.rows(), 3, 1.0);
  run.solution->reaction_force = Points::Ones(vertices.rows(), 3);
  run.solution->spacing.assign(static_cast<std::size_t>(vertices.rows()), 5.0);
  const View view = make_view(run);
  EXPECT_EQ(view.opening.rows(), 0);
  EXPECT_NEAR(view.slices[0].plane.corner.z(), vertices.col(2).mean(), 1e-9);
}

TEST(View, OpeningsOnBothSidesAreOpenings) {
  RunData run = small_run();
  const Points& vertices = run.brain->vertices;
  run.solution->positions = vertices;
  run.solution->displacement = Points::Constant(vertices.rows(), 3, 1.0);
  run.solution->spacing.assign(static_cast<std::size_t>(vertices.rows()), 5.0);
  run.solution->reaction_force = Points::Zero(vertices.rows(), 3);
  const Eigen::VectorXd across = vertices.col(0).cwiseAbs();
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    run.solution->reaction_force(i, 0) = across[i] > 0.9 * across.maxCoeff() ? 1 : 0;
  }
  EXPECT_GT(make_view(run).opening.rows(), 1);
}

TEST(View, WithoutALoadThePlanesCutTheMiddle) {
  RunData run = small_run();
  run.solution->reaction_force.setZero();
  run.t1.reset();
  const View view = make_view(run);
  EXPECT_EQ(view.opening.rows(), 0);
  EXPECT_NEAR(view.slices[0].plane.corner.z(), 0, 1e-9);
  EXPECT_EQ(view.brightest, 1);
}

}  // namespace brainshift::pipelines::view_test
