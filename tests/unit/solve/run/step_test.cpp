// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solve/arrays/nodal_vectors.hpp"
#include "solve/run/completed.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/cut_bodies.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::step_test {

using test::expect_parts;

/// What stepping makes of a prepared model; start: displacements at the nodes, for the parameters to start from.
SolveResult stepped(const Model& model, const SolveOptions& given, const Points& start = Points(0, 3)) {
  const SolveOptions options = completed(given, model);
  SolveMeasures measures;
  Prepared prepared = prepare(model, options, {}, measures, {});
  measures.seconds_setup = 7;
  NodalVectors parameters(start.rows() == 0 ? 0 : 4 * model.cloud.size(), 0.0);
  for (std::size_t a = 0; 4 * a < parameters.size(); ++a) {
    at(parameters, a).head<3>() = start.row(prepared.body.original[a]);
  }
  const std::optional<InsideBody> inside = prepared.cut ? std::optional(prepared.cut->inside) : std::nullopt;
  SolveResult result = step_to_end(model, options, std::move(prepared), measures, std::move(parameters), {});
  if (inside) {
    draw_faces(*inside, result);
  }
  return result;
}

TEST(StepToEnd, KeepsWhatPreparingMeasuredAndAddsTheRest) {
  const Model model = uniaxial(1.1, 5);
  const SolveResult result = stepped(model, {});
  const SolveMeasures& m = result.measures;
  EXPECT_EQ(result.failure, "");
  EXPECT_TRUE(m.converged);
  EXPECT_EQ(m.seconds_setup, 7);
  EXPECT_EQ(m.nodes, model.cloud.size());
  EXPECT_EQ(m.steps, result.history.back().step);
  EXPECT_LE(m.error_bound, SolveOptions().tolerance);
  EXPECT_LE(m.constraint_error, 1e-9);
  EXPECT_NEAR(m.largest_stretch, 1.15, 0.05);
  EXPECT_EQ(m.largest_displacement, result.solution.displacement.rowwise().norm().maxCoeff());
  EXPECT_FALSE(m.cut);
  EXPECT_EQ(m.contact_nodes, 0U);
  EXPECT_TRUE(result.stress_strain.empty());
}

TEST(StepToEnd, GivesTheFieldAndTheForcesInTheOrderOfTheCloud) {
  const Model model = uniaxial(1.1, 5);
  const Solution solution = stepped(model, {}).solution;
  EXPECT_EQ(solution.positions, model.cloud.positions);
  EXPECT_EQ(solution.spacing, model.cloud.spacing);
  for (Eigen::Index a = 0; a < solution.positions.rows(); ++a) {
    for (int axis = 0; axis < 3; ++axis) {
      const double prescribed = model.conditions.displacement(a, axis);
      if (std::isnan(prescribed)) {
        EXPECT_EQ(solution.reaction_force(a, axis), 0);
      } else {
        EXPECT_NEAR(solution.displacement(a, axis), prescribed, 1e-9);
      }
    }
  }
  const double pull = solution.reaction_force.col(2).cwiseMax(0).sum();  // N: about E ε A
  EXPECT_NEAR(pull, 3000e-6 * 0.1 * model_side * model_side, 0.15 * pull);
  EXPECT_NEAR(solution.reaction_force.col(2).sum(), 0, 0.01 * pull) << "it is at rest";
}

TEST(StepToEnd, FromTheEndIsThereInFewerSteps) {
  const Model model = uniaxial(1.1, 5);
  const SolveResult from_rest = stepped(model, {});
  const SolveResult from_end = stepped(model, {}, from_rest.solution.displacement);
  ASSERT_EQ(from_end.failure, "");
  EXPECT_LT(from_end.measures.steps, 2 * from_rest.measures.steps / 3);
  const Points change = from_end.solution.displacement - from_rest.solution.displacement;
  EXPECT_LT(change.rowwise().norm().maxCoeff(), 2 * SolveOptions().tolerance);
}

TEST(StepToEnd, KeepsTheLastStateOfAMotionThatDoesNotComeToRest) {
  SolveOptions options;
  options.max_steps = 5;
  const SolveResult result = stepped(uniaxial(1.1, 5), options);
  expect_parts(result.failure, {"5 steps"});
  EXPECT_FALSE(result.measures.converged);
  EXPECT_EQ(result.measures.steps, 5);
  EXPECT_TRUE(result.solution.displacement.allFinite());
}

TEST(StepToEnd, SaysWhereABodyBecameUnstable) {
  const SolveResult result = stepped(uniaxial(-0.5, 5), {});
  expect_parts(result.failure, {"unstable at step", "mm"});
  EXPECT_TRUE(result.solution.displacement.allFinite());
}

TEST(StepToEnd, MeasuresTheContactWithTheSkull) {
  Model model = uniaxial(0.9, 5);
  const auto farthest_free_node = [&](const SolveResult& result) {
    double x = 0;
    for (Eigen::Index a = 0; a < result.solution.positions.rows(); ++a) {
      const bool is_free = model.conditions.displacement.row(a).array().isNaN().all();
      x = is_free ? std::max(x, result.solution.positions(a, 0) + result.solution.displacement(a, 0)) : x;
    }
    return x;
  };
  const double wall = model_side + 1;
  EXPECT_GT(farthest_free_node(stepped(model, {})), wall + 1) << "without a skull";
  model.skull = test::box({-5, -5, -5}, {wall, wall, model_side + 5});
  const SolveResult result = stepped(model, {});
  ASSERT_EQ(result.failure, "");
  EXPECT_GT(result.measures.contact_nodes, 5U);
  EXPECT_LT(result.measures.largest_penetration, 0.3);
  EXPECT_LE(farthest_free_node(result), wall + result.measures.largest_penetration + 1e-6);
}

TEST(StepToEnd, MeasuresAndDrawsACutAndItsSnapshots) {
  Model model = test::strip(1.1);
  model.cuts = {test::cut_path({{10, -1}, {10, 12}})};
  SolveOptions options = test::plane_options();
  options.snapshot_every = 100;
  const SolveResult result = stepped(model, options);
  ASSERT_EQ(result.failure, "");
  ASSERT_TRUE(result.measures.cut);
  const CutMeasures& cut = *result.measures.cut;
  EXPECT_NEAR(cut.extent, 13 + model.cloud.spacing[0], 1e-9) << "mm; it is taken beyond its end outside";
  EXPECT_EQ(model.cloud.size() + cut.added_nodes, static_cast<std::size_t>(result.solution.positions.rows()));
  EXPECT_FALSE(cut.faces) << "nobody asked for their contact";
  EXPECT_GT(result.faces.vertices.rows(), 0);
  ASSERT_FALSE(result.snapshots.empty());
  for (const Snapshot& snapshot : result.snapshots) {
    EXPECT_EQ(snapshot.faces.vertices, result.faces.vertices) << "it was cut from the start";
    EXPECT_EQ(snapshot.displacement.rows(), snapshot.positions.rows());
  }
}

TEST(StepToEnd, HasAStressStrainCurveWhereABodyMayTear) {
  Model model = test::strip(1.1, Plane::stress);
  model.rupture.emplace().strength = 2;
  SolveOptions options = test::plane_options();
  options.max_steps = 200;  // it need not come to rest
  const SolveResult result = stepped(model, options);
  ASSERT_FALSE(result.stress_strain.empty());
  const StressStrainRow& last = result.stress_strain.back();
  EXPECT_NEAR(last.elongation, 0.1 * model.curve.at(last.time), 1e-12);
}

}  // namespace brainshift::solve::step_test
