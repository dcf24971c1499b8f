// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/transient.hpp"

#include <gtest/gtest.h>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/swinging_bar.hpp"

namespace brainshift::solve::transient_test {

constexpr double side = model_side;
using Join = LoadCurve::Join;

TEST(Transient, ABarSwingsWithItsFirstLongitudinalFrequency) {
  const SwingingBar bar;
  SolveOptions options = in_time();
  options.points_per_cell = 4;
  options.time_step = 1e-4;
  options.snapshot_every = 1;
  const SolveResult result = solve(bar.model, options);
  ASSERT_TRUE(result.measures.converged) << result.failure;
  const auto [passages, last_passage] = SwingingBar::passages(result.snapshots);
  ASSERT_EQ(passages, 6);
  const double ratio = (2 * passages - 1) * bar.period / 4 / last_passage;
  RecordProperty("frequency_ratio", std::to_string(ratio));
  EXPECT_NEAR(ratio, 1, 0.03);
}

TEST(Transient, NothingHoldsABodyInFreeFall) {
  constexpr double end = 0.3;
  const auto fall = [&](Plane plane, double jitter, double modulus) {
    Model model;
    model.plane = plane;
    model.cloud =
        plane == Plane::none ? test::irregular_box(4, side, jitter) : test::irregular_rectangle(6, 5, side, 50, jitter);
    model.cells = plane == Plane::none ? test::box_cells(3, side) : test::rectangle_cells(5, 4, side, 50);
    model.materials[1] = {.youngs_modulus = modulus, .poisson_ratio = 0.3};
    model.gravity = {3, -9.81, 0};
    model.curve = LoadCurve({0, end}, {0, 1}, Join::straight);
    SolveOptions options = in_time();
    options.points_per_cell = plane == Plane::none ? 8 : 4;
    const SolveResult result = solve(model, options);
    EXPECT_TRUE(result.measures.converged) << result.failure;
    EXPECT_EQ(result.solution.reaction_force.norm(), 0);
    const double mass = model.materials[1].density * 1e-9 * side * (plane == Plane::none ? side * side : 50);  // kg
    for (const HistoryRow& row : result.history) {
      const double speed = model.gravity.norm() * row.time * row.time / (2 * end), energy = 500 * mass * speed * speed;
      EXPECT_NEAR(row.kinetic_energy, energy, 0.01 * energy + 1e-9) << row.time;
    }
    const Eigen::RowVector3d fallen = 1000 * model.gravity * end * end / 6;  // ∬ g t/T, mm
    return (result.solution.displacement.rowwise() - fallen).rowwise().norm().maxCoeff() / fallen.norm();
  };
  for (const Plane plane : {Plane::none, Plane::strain}) {
    EXPECT_LE(fall(plane, 0, 1e6), 1e-3);
    EXPECT_LE(fall(plane, 0, 3000), 1e-3);
    EXPECT_LE(fall(plane, 0.25, 1e6), 1e-3);
  }
}

TEST(Transient, ReactionOfAHeldStretchRelaxesAsThePronySeriesSays) {
  const std::vector<PronyTerm> series = {{0.450, 0.50}, {0.365, 50}};
  constexpr double stretch = 1.2, rise = 0.1;
  Model model = stretched(stretch, rise, 1.5);
  model.materials[1].prony = series;
  const SolveResult result = solve(model, in_time(30));
  ASSERT_TRUE(result.measures.converged) << result.failure;
  int compared = 0;
  for (const HistoryRow& row : result.history) {
    if (row.time < 0.5) {
      continue;  // still swinging
    }
    Material now = model.materials[1];
    double gone = 0;
    for (const PronyTerm& term : series) {
      gone += term.share * (1 - std::exp(-(row.time - rise / 2) / term.time));
    }
    now.prony = {{gone, 1}};
    const double expected = uniaxial_answer(long_term(now), stretch).first * side * side * 1e-6;
    EXPECT_NEAR(row.reaction.z(), expected, 0.02 * expected) << row.time;
    ++compared;
  }
  EXPECT_GE(compared, 3);
  const double first = uniaxial_answer(model.materials[1], stretch).first * side * side * 1e-6;
  EXPECT_LT(result.history.back().reaction.z(), 0.62 * first);
}

TEST(Transient, ErrorFallsWithTheSquareOfTheStep) {
  const auto end_state = [](double time_step) {
    SolveOptions options = in_time();
    options.time_step = time_step;
    return Points(solve(stretched(1.1, 0.1, 0), options).solution.displacement);
  };
  SolveResult automatic = solve(stretched(1.1, 0.1, 0), in_time());
  const double step = 0.1 / automatic.measures.steps;
  EXPECT_NEAR(step, 0.85 * automatic.measures.critical_step, 0.15 * automatic.measures.critical_step);
  const Points exact = end_state(step / 8);
  const double once = (automatic.solution.displacement - exact).norm(), halved = (end_state(step / 2) - exact).norm();
  EXPECT_LE(once, 0.01 * exact.norm());
  EXPECT_GE(once / halved, 3.3);
}

TEST(Transient, RefusesAStepAboveTheCriticalOne) {
  const Model model = stretched(1.1, 0.1, 0);
  SolveOptions options = in_time();
  options.time_step = 0.02;
  try {
    solve(model, options);
    FAIL() << "a step of " << options.time_step << " s was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("above the critical one"), std::string::npos) << error.what();
  }
}

TEST(Transient, RefusesAMotionOfLessThanAFewSteps) {
  const auto fault_of = [](double duration) {
    return test::refusal([&] { solve(stretched(1.1, duration, 0), in_time()); });
  };
  const std::string fault = fault_of(1e-9);
  EXPECT_NE(fault.find("to last 1e-09 s, less than five steps of"), std::string::npos) << fault;
  EXPECT_NE(fault.find("longer duration"), std::string::npos) << fault;
}

TEST(Transient, SaysWhenItNeedsMoreSteps) {
  SolveOptions options = in_time();
  options.max_steps = 10;
  const SolveResult result = solve(stretched(1.1, 0.1, 0), options);
  EXPECT_FALSE(result.measures.converged);
  EXPECT_NE(result.failure.find("stopped after 10 steps"), std::string::npos) << result.failure;
}

TEST(Transient, ReturnsWithTheCurveToWhereItStarted) {
  Model model = stretched(1.3, 1, 0);
  model.curve = LoadCurve({0, 0.6, 1.2, 1.5}, {0, 1, 0, 0}, Join::smooth);
  const SolveResult result = solve(model, in_time(20));
  ASSERT_TRUE(result.measures.converged) << result.failure;
  double largest = 0, pull = 0;
  for (const HistoryRow& row : result.history) {
    largest = std::max(largest, row.strain_energy);
    pull = std::max(pull, row.reaction.norm());
  }
  EXPECT_LE(result.measures.largest_displacement, 0.01 * 0.3 * side);
  EXPECT_LE(result.history.back().strain_energy, 1e-3 * largest);
  EXPECT_LE(result.history.back().reaction.norm(), 0.01 * pull);
}

TEST(Transient, ReactionOfTheHistoryIsThatOfTheLoadedNodes) {
  const Model model = stretched(1.2, 0.2, 0);
  const SolveResult result = solve(model, in_time());
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if ((model.conditions.displacement.row(a).array().abs() > 0).any()) {
      sum += result.solution.reaction_force.row(a);
    }
  }
  EXPECT_GT(sum.norm(), 0);
  EXPECT_LE((result.history.back().reaction.transpose() - sum).norm(), 1e-12 * sum.norm());
}

}  // namespace brainshift::solve::transient_test
