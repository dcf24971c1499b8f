// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/update/kept_run.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "solve/dynamics/damping_turns.hpp"
#include "solve/shape/too_few_nodes.hpp"
#include "solve/solve.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/measured_box.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/pressed_bar.hpp"
#include "tests/unit/solve/turned_cube.hpp"

namespace brainshift::solve::kept_run_test {

constexpr double tolerance = 0.001;  // mm

SolveOptions options() {
  SolveOptions options;
  options.tolerance = tolerance;
  return options;
}

KeptRun kept(const Model& model, const SolveOptions& options = kept_run_test::options()) {
  KeptRun run = keep(model, options, solve(model, options).solution.displacement);
  run.made_from = [model] { return model; };
  return run;
}

/// Linear, and not to the last: for bodies that take many steps.
SolveOptions quick() {
  SolveOptions options;
  options.shape.basis = Basis::linear;
  options.tolerance = 0.004;
  return options;
}

/// Made once: to be copied, as an update changes it.
const KeptRun& kept_bar() {
  static const KeptRun run = kept(pressed_bar(8), quick());
  return run;
}

double distance(const Points& a, const Points& b) {
  return (a - b).rowwise().norm().maxCoeff();
}

TEST(KeptRun, AnswersAnotherLoadAsARunFromTheBeginning) {
  KeptRun run = kept(uniaxial(0.9, 5));
  const Model other = uniaxial(0.85, 5);
  const SolveResult answer = update(run, other.conditions.displacement);
  EXPECT_TRUE(answer.measures.converged) << answer.failure;
  EXPECT_LE(answer.measures.error_bound, tolerance);
  EXPECT_LE(distance(answer.solution.displacement, solve(other, options()).solution.displacement), 2 * tolerance);
}

TEST(KeptRun, HoldsInsideTheRimOfAPatchAsARunFromTheBeginning) {
  Model model = pressed_bar(8);
  KeptRun run = kept_bar();
  model.conditions.displacement *= 1.2;
  const SolveResult answer = update(run, model.conditions.displacement), anew = solve(model, quick());
  EXPECT_TRUE(answer.measures.converged) << answer.failure;
  EXPECT_LE(distance(answer.solution.displacement, anew.solution.displacement), 2 * quick().tolerance);
  model.conditions.at_nodes_alone = true;
  EXPECT_GT(distance(solve(model, quick()).solution.displacement, anew.solution.displacement), 0.1);
  EXPECT_NE(cannot_keep(model, quick()), "");
}

/// The responses are of the run's own load: back at it nothing is left to do, wherever the last answer lies.
TEST(KeptRun, IsAtOnceBackAtItsOwnLoad) {
  const Model own = uniaxial(0.9, 5);
  KeptRun run = kept(own);
  const Points before = run.displacement;
  const int there = update(run, uniaxial(0.7, 5).conditions.displacement).measures.steps;
  const SolveResult back = update(run, own.conditions.displacement);
  EXPECT_LE(distance(back.solution.displacement, before), tolerance);
  EXPECT_LT(back.measures.steps, there);
}

TEST(KeptRun, LearnsFromItsAnswers) {
  const Model own = uniaxial(0.9, 5);
  KeptRun fresh = kept(own);
  KeptRun taught = fresh;
  for (const double stretch : {0.8, 0.95}) {
    update(taught, uniaxial(stretch, 5).conditions.displacement);
  }
  const Points asked = uniaxial(0.83, 5).conditions.displacement;
  const SolveResult first = update(fresh, asked), later = update(taught, asked);
  EXPECT_LT(later.measures.steps, first.measures.steps);
  EXPECT_LE(distance(later.solution.displacement, first.solution.displacement), 2 * tolerance);
}

/// Every node moves by itself, so that no wave tells much of it.
TEST(KeptRun, AnswersARoughChangeWithinItsBound) {
  Model model = pressed_bar(8);
  KeptRun run = kept_bar();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> by(-0.5, 0.5);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.conditions.displacement(a, 2) > 0) {
      model.conditions.displacement.row(a) += Eigen::RowVector3d::NullaryExpr([&] { return by(random); });
    }
  }
  KeptRun closely = run;
  closely.options.tolerance *= 0.02;
  const SolveResult answer = update(run, model.conditions.displacement);
  const SolveResult right = update(closely, model.conditions.displacement);
  ASSERT_TRUE(answer.measures.converged && right.measures.converged) << answer.failure << right.failure;
  EXPECT_GT(answer.measures.steps, DampingTurns::if_far);
  EXPECT_LE(distance(answer.solution.displacement, right.solution.displacement), answer.measures.error_bound);
}

/// Nodes of the last layer that a load no longer holds, or holds anew, are nothing that responses know.
TEST(KeptRun, AnswersALoadOfOtherNodes) {
  const Model own = uniaxial(0.9, 5);
  KeptRun run = kept(own);
  Model other = uniaxial(0.85, 5);
  const Points& places = other.cloud.positions;
  for (Eigen::Index a = 0; a < places.rows(); ++a) {
    if (places(a, 0) == places.col(0).maxCoeff() && places(a, 1) == places.col(1).maxCoeff()) {
      other.conditions.displacement.row(a).setConstant(std::nan(""));
    }
  }
  const Points expected = solve(other, options()).solution.displacement;
  EXPECT_LE(distance(update(run, other.conditions.displacement).solution.displacement, expected), 2 * tolerance);
  const SolveResult back = update(run, own.conditions.displacement);
  EXPECT_LE(distance(back.solution.displacement, run.origin.displacement), 2 * tolerance);
}

/// Derivatives are corrected otherwise beside what is held: beside the part of a patch that a load leaves out, too.
TEST(KeptRun, AnswersALoadOfAPartOfThePatchAsARunFromTheBeginning) {
  const Model own = pressed_bar(8);
  Model other = own;
  const Points& places = other.cloud.positions;
  const double middle = places.col(0).mean();
  for (Eigen::Index a = 0; a < places.rows(); ++a) {
    if (other.conditions.displacement(a, 2) > 0 && places(a, 0) > middle) {
      other.conditions.displacement.row(a).setConstant(std::nan(""));
    }
  }
  const SolveResult anew = solve(other, quick());
  KeptRun run = kept_bar();
  const SolveResult answer = update(run, other.conditions.displacement);
  ASSERT_TRUE(answer.measures.converged) << answer.failure;
  EXPECT_LE(distance(answer.solution.displacement, anew.solution.displacement), 2 * quick().tolerance);
  EXPECT_TRUE(update(run, 1.05 * other.conditions.displacement).measures.converged);
  EXPECT_LE(distance(update(run, own.conditions).solution.displacement, run.origin.displacement),
            2 * quick().tolerance);
  run.made_from = nullptr;
  EXPECT_NE(test::refusal([&] { update(run, other.conditions); }).find("other nodes"), std::string::npos);
}

TEST(KeptRun, IsAsItWasAfterALoadThatItRefuses) {
  const Model own = uniaxial(0.9, 5);
  KeptRun run = kept(own);
  EXPECT_THROW(update(run, Points::Constant(own.cloud.positions.rows(), 3, std::nan(""))), std::invalid_argument);
  Points endless = own.conditions.displacement;
  endless(3, 1) = INFINITY;
  EXPECT_NE(test::refusal([&] { update(run, endless); }).find("node 3 is infinite"), std::string::npos);
  const SolveResult back = update(run, own.conditions.displacement);
  EXPECT_LE(distance(back.solution.displacement, run.origin.displacement), tolerance);
}

TEST(KeptRun, IsAsItWasAfterConditionsThatRepeatEachOther) {
  const Model own = uniaxial(0.9, 5);
  KeptRun run = kept(own);
  ShapeRows repeated;
  for (std::size_t a = 0; a < run.fine.body.nodal_rows.size(); ++a) {
    repeated.append(run.fine.body.nodal_rows[a / 2]);
  }
  const ShapeRows rows = std::exchange(run.fine.body.nodal_rows, repeated);
  EXPECT_THROW(update(run, own.conditions.displacement), TooFewNodes);
  run.fine.body.nodal_rows = rows;
  const SolveResult back = update(run, own.conditions.displacement);
  EXPECT_LE(distance(back.solution.displacement, run.origin.displacement), tolerance);
}

/// Steps are then made of rounding from the first on.
TEST(KeptRun, AnswersTheSameLoadAgainInSinglePrecision) {
  const Model own = uniaxial(0.9, 5);
  SolveOptions single = options();
  single.tolerance = 0.005;
  single.precision = Precision::single_precision;
  KeptRun run = keep(own, single, solve(own, single).solution.displacement);
  ASSERT_EQ(run.options.precision, Precision::single_precision);
  const Points before = run.displacement;
  for (int again = 0; again < 12; ++again) {
    const double factor = 1 + again * 1e-9;
    const SolveResult answer = update(run, factor * own.conditions.displacement);
    ASSERT_TRUE(answer.measures.converged) << answer.failure;
    EXPECT_LE(distance(answer.solution.displacement, before), single.tolerance) << again;
    EXPECT_FALSE(answer.history.empty());
  }
}

/// They are solved to a fiftieth of the tolerance, which rounding does not leave to slow bodies.
TEST(KeptRun, KnowsItsResponsesInSinglePrecision) {
  Model model = pressed_bar(8);
  model.conditions.displacement *= 2;
  SolveOptions single = quick();
  single.precision = Precision::single_precision;
  const KeptRun run = kept(model, single);
  ASSERT_EQ(run.options.precision, Precision::single_precision);
  EXPECT_EQ(run.responses.count(), std::min<std::size_t>(16, run.responses.nodes.size()));
}

/// Measured anew: more of the same, and other noise.
Model measured_again(Model model) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.3);
  Measurement& measured = *model.conditions.measured;
  for (double& u : measured.cortex_displacement.reshaped()) {
    u = 1.2 * u + noise(random);
  }
  const Points at_nodes = measured.spread * measured.cortex_displacement;
  for (Eigen::Index a = 0; a < at_nodes.rows(); ++a) {
    if (measured.spread.row(a).norm() > 0) {
      model.conditions.displacement.row(a) = at_nodes.row(a);
    }
  }
  return model;
}

/// What the fit leaves of the noise differs from load to load: the opening held exactly, springs inside, more of them,
/// springs everywhere, none as there is no noise. Nothing of one load is left for the next.
TEST(KeptRun, WeighsTheNoiseOfEachLoadAsARunFromTheBeginning) {
  const Model own = measured_box(0.5), other = measured_again(own);
  KeptRun run = kept(own, quick());
  EXPECT_GT(run.responses.count(), 0U);
  const Points there = run.origin.displacement;
  for (const Model& model : {other, with_inner(own, 1), with_weight(other, 0.05), without_noise(other),
                             with_weight(own, 0.2), with_inner(other, 2)}) {
    const SolveResult answer = update(run, model.conditions), anew = solve(model, quick());
    ASSERT_TRUE(answer.measures.converged) << answer.failure;
    EXPECT_LE(distance(answer.solution.displacement, anew.solution.displacement), 2 * quick().tolerance);
    ASSERT_EQ(answer.measures.measured.has_value(), anew.measures.measured.has_value());
    if (anew.measures.measured) {
      EXPECT_NEAR(answer.measures.measured->weight / anew.measures.measured->weight, 1, 1e-6);
    }
  }
  EXPECT_GT(distance(run.displacement, there), 100 * quick().tolerance);
  EXPECT_LE(distance(update(run, own.conditions).solution.displacement, there), 2 * quick().tolerance);
}

TEST(KeptRun, IsOfPointsInsideAlone) {
  Model model = with_inner(measured_box(0.5), 2);
  const auto nodes = model.cloud.positions.rows();
  for (Eigen::Index a = 0; a < nodes; ++a) {
    if (model.conditions.measured->spread.row(a).norm() > 0) {
      model.conditions.displacement.row(a).setConstant(std::nan(""));
    }
  }
  Measurement& measured = *model.conditions.measured;
  measured.spread.resize(nodes, 0);
  measured.cortex = measured.cortex_displacement = measured.sigma = Points(0, 3);
  KeptRun run = kept(model, quick());
  EXPECT_EQ(run.responses.count(), 0U);
  measured.inner_displacement *= 1.5;
  const SolveResult answer = update(run, model.conditions);
  ASSERT_TRUE(answer.measures.converged) << answer.failure;
  EXPECT_LE(distance(answer.solution.displacement, solve(model, quick()).solution.displacement), 2 * quick().tolerance);
  model.conditions.displacement = Points(0, 3);
  measured.inner.conservativeResize(1, 3);
  EXPECT_THROW(update(run, model.conditions), std::invalid_argument) << "the body may turn about the point";
}

TEST(KeptRun, RefusesNoiseWhereItsOwnLoadHadNoneAndAnUnknownRegistration) {
  Model model = measured_box(0.5);
  const Conditions noisy = model.conditions;
  model.conditions.measured->registration_unknown = true;
  EXPECT_NE(cannot_keep(model, quick()), "");
  model.conditions.measured.reset();
  KeptRun run = kept(model, quick());
  EXPECT_NE(test::refusal([&] { update(run, noisy); }).find("standard deviations"), std::string::npos);
  const SolveResult back = update(run, model.conditions);
  EXPECT_LE(distance(back.solution.displacement, run.origin.displacement), quick().tolerance);
}

/// A cube that hangs from a patch and turns with it slowly.
TEST(KeptRun, AnswersOfASlowBodyAsARunDoes) {
  const auto turned = [](double angle) {
    return turned_by_a_patch(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix());
  };
  KeptRun run = kept(turned(0.1), quick());
  EXPECT_EQ(run.responses.count(), 0U);
  const Model other = turned(0.15);
  const SolveResult answer = update(run, other.conditions);
  ASSERT_TRUE(answer.measures.converged) << answer.failure;
  const Points right =
      turn_of(other.cloud.positions, Eigen::AngleAxisd(0.15, Eigen::Vector3d::UnitX()).toRotationMatrix());
  EXPECT_LE(distance(answer.solution.displacement, right), 2 * quick().tolerance);
}

/// Damped for ten times too quick a motion, answers stop too early.
TEST(KeptRun, IsTrustedAsFarAsItAnswersHonestly) {
  const Model model = pressed_bar(8);
  KeptRun run = kept_bar();
  EXPECT_EQ(run.trusted, 6);
  run.origin.lowest = 0.01;
  run.responses = {};
  EXPECT_EQ(trusted_change(run, model.conditions, {}), 2);
}

TEST(KeptRun, RefusesASolutionOfAnotherCloud) {
  Model model = measured_box(0.5);
  model.conditions.measured.reset();
  const Points fewer = Points::Zero(model.cloud.positions.rows() - 3, 3);
  EXPECT_NE(test::refusal([&] { keep(model, quick(), fewer); }).find("its cloud"), std::string::npos);
}

TEST(KeptRun, AnswersFromItsFileAsFromMemory) {
  const test::ScratchFolder scratch;
  const Model model = measured_box(0.5);
  KeptRun run = kept(model, quick());
  write_kept(scratch / "kept.bin", run, "key");
  EXPECT_FALSE(read_kept(scratch / "kept.bin", "other", model.materials, quick()));
  std::optional<KeptRun> read = read_kept(scratch / "kept.bin", "key", model.materials, quick());
  ASSERT_TRUE(read);
  const Model other = measured_again(model);
  const SolveResult here = update(run, other.conditions), there = update(*read, other.conditions);
  EXPECT_EQ(here.solution.displacement, there.solution.displacement);
}

}  // namespace brainshift::solve::kept_run_test
