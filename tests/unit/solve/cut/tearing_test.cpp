// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/cut/tearing.hpp"

#include <gtest/gtest.h>

#include "solve/output/stress_strain.hpp"
#include "tests/unit/solve/cut_bodies.hpp"

namespace brainshift::solve::tearing_test {

using test::cut_path;
using test::strip;
using test::strip_length;
using test::strip_width;

/// A strip in plane stress that is pulled by half its length and tears at a stretch of 1.3.
Model torn_strip() {
  Model model = strip(1.5, Plane::stress);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double x = model.cloud.positions(a, 0);
    if (x == 0 || x == strip_length) {
      model.conditions.displacement(a, 1) = 0;
    }
  }
  model.rupture.emplace();
  model.rupture->strength = 1.3;
  model.curve = LoadCurve({0, 1}, {0, 1}, LoadCurve::Join::straight);
  return model;
}

SolveResult torn(const Model& model, int load_steps) {
  SolveOptions options = test::plane_options();
  options.load_steps = load_steps;
  options.shape.basis = Basis::linear;
  return solve(model, options);
}

TEST(Tearing, PartsAStripWhereItIsWeakAndTheStressFallsToZero) {
  Model model = torn_strip();
  model.rupture->weak_spots = {{{18, 0}, 4, 0.7}};
  const SolveResult result = torn(model, 400);
  ASSERT_EQ(result.failure, "");
  const auto curve = stress_strain(model, Dynamics::relaxation, result.history);
  const auto largest =
      std::max_element(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.stress < b.stress; });
  EXPECT_GT(largest->elongation, 0.1);
  EXPECT_LT(largest->elongation, 0.32);
  EXPECT_LT(std::abs(curve.back().stress), 0.01 * largest->stress);
  const Points& vertices = result.solution.cut.vertices;
  EXPECT_NEAR(vertices.col(0).mean(), 18, 3) << "the tear runs across from the weak spot";
  EXPECT_GT(vertices.col(1).maxCoeff() - vertices.col(1).minCoeff(), strip_width);
}

TEST(Tearing, StressRisesToItsPeakAndFallsWithoutSwings) {
  Model model = torn_strip();
  model.rupture->weak_spots = {{{18, 0}, 4, 0.7}};
  for (const int load_steps : {400, 1000}) {
    const SolveResult result = torn(model, load_steps);
    ASSERT_EQ(result.failure, "");
    const auto curve = stress_strain(model, Dynamics::relaxation, result.history);
    const auto largest =
        std::max_element(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.stress < b.stress; });
    ASSERT_GT(largest - curve.begin(), 20);
    ASSERT_GT(curve.end() - largest, 10);
    double most = 0, least = largest->stress;
    for (auto row = curve.begin(); row != curve.end(); ++row) {
      double& bound = row < largest ? most : least;
      bound = row < largest ? std::max(bound, row->stress) : std::min(bound, row->stress);
      const double swing = row < largest ? most - row->stress : std::max(row->stress - least, -row->stress);
      EXPECT_LT(swing, (row < largest ? 0.01 : 0.08) * largest->stress) << "at " << row->elongation;
    }
    EXPECT_EQ(curve.back().time, 1);
  }
}

TEST(Tearing, StressOfAStripIsThatOfUniaxialTension) {
  const Model model = [] {
    Model m = torn_strip();
    m.rupture->strength = 10;
    return m;
  }();
  const SolveResult result = torn(model, 400);
  const auto curve = stress_strain(model, Dynamics::relaxation, result.history);
  EXPECT_NEAR(curve.back().elongation, 0.5, 1e-9);
  EXPECT_NEAR(curve.back().stress, 3000.0 / 3 * (1.5 - 1 / 2.25), 0.12 * 1055) << "but for the clamped ends";
  EXPECT_EQ(result.measures.cut->extent, 0);
}

TEST(Tearing, GoesOnFromTwoNotchesAtOnce) {
  Model model = torn_strip();
  model.rupture->strength = 1.6;
  model.cuts = {cut_path({{15, -1}, {15, 4}}), cut_path({{15, 21}, {15, 16}})};
  const SolveResult result = torn(model, 400);
  ASSERT_EQ(result.failure, "");
  const auto y = result.solution.cut.vertices.col(1).array();
  EXPECT_GT((y > 4.5 && y < 8).count(), 0);
  EXPECT_GT((y > 12 && y < 15.5).count(), 0);
}

TEST(Tearing, IsTheSameForTheSameSeed) {
  Model model = torn_strip();
  model.rupture->scatter = 0.2;
  const SolveResult one = torn(model, 400), two = torn(model, 400);
  EXPECT_EQ(one.solution.cut.vertices, two.solution.cut.vertices);
  model.rupture->seed = 2;
  const SolveResult other = torn(model, 400);
  EXPECT_NE(one.solution.cut.vertices.topRows(1), other.solution.cut.vertices.topRows(1));
}

}  // namespace brainshift::solve::tearing_test
