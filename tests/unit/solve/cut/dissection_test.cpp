// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts of bodies: before they move and while they do.
#include "solve/cut/dissection.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solve/cut/cut_body.hpp"
#include "solve/output/field_difference.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/cut_bodies.hpp"

namespace brainshift::solve::dissection_test {

using test::cut_path;
using test::strip;
using test::strip_length;
using test::strip_width;

std::string refusal(const Model& model, const SolveOptions& options = test::plane_options()) {
  return test::refusal([&] { solve(model, options); });
}

TEST(Cut, AlongTheStretchChangesNothing) {
  Model model = strip(1.2);
  SolveOptions options = test::plane_options();
  options.tolerance = 1e-4;
  const SolveResult whole = solve(model, options);
  model.cuts = {cut_path({{8, 9.3}, {22, 9.3}})};
  const SolveResult cut = solve(model, options);
  EXPECT_LT(field_difference(whole.solution, cut.solution).largest, 1e-3);  // of 6 mm
  EXPECT_NEAR(cut.history.back().reaction.x() / whole.history.back().reaction.x(), 1, 1e-5);
}

TEST(Cut, ThroughTheBodyLeavesPartsThatMoveAlone) {
  Model model = strip(1.2);
  model.cuts = {cut_path({{14.6, -1}, {15.9, 21}})};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 0) == strip_length) {
      model.conditions.displacement(a, 1) = 0;  // the part that is pulled off is held, too
    }
  }
  const SolveResult result = solve(model, test::plane_options());
  EXPECT_EQ(result.failure, "");
  EXPECT_LT(std::abs(result.history.back().reaction.x()), 1e-3 * 3e-3 * strip_width * 0.2);
  for (Eigen::Index a = 0; a < result.solution.positions.rows(); ++a) {
    const bool left = result.solution.positions(a, 0) < 14.6 + 1.3 * (result.solution.positions(a, 1) + 1) / 22;
    EXPECT_NEAR(result.solution.displacement(a, 0), left ? 0 : 6, 0.05);
  }
}

Model cut_on_the_way(const std::vector<std::pair<double, double>>& corners, const std::vector<double>& time) {
  Model model = strip(1.2);
  model.cuts = {cut_path(corners, time)};
  model.curve = LoadCurve({0, 1, 2.5}, {0, 1, 1}, LoadCurve::Join::smooth);
  return model;
}

TEST(Dissection, EndsWhereTheBodyCutBeforeEnds) {
  Model model = cut_on_the_way({{13.2, -0.5}, {14.1, 9.2}}, {1, 2});
  SolveOptions options = test::plane_options();
  options.load_steps = 2000;
  const SolveResult on_the_way = solve(model, options);
  ASSERT_EQ(on_the_way.failure, "");
  model.cuts[0].time.clear();
  const SolveResult before = solve(model, options);
  EXPECT_NEAR(on_the_way.history.back().reaction.x() / before.history.back().reaction.x(), 1, 0.02);
  EXPECT_LT(field_difference(before.solution, on_the_way.solution).mean, 0.06);  // 1 % of the pull
  EXPECT_GT(on_the_way.measures.cut->advances, 5u);
  EXPECT_LT(on_the_way.measures.cut->touched_supports,
            on_the_way.measures.cut->advances * on_the_way.measures.integration_points / 3);
}

/// The first advances touch no node.
TEST(Dissection, MayBeginFarOutsideTheBody) {
  const SolveResult near = solve(cut_on_the_way({{14.6, -0.5}, {14.6, 9.2}}, {1, 2}), test::plane_options());
  const SolveResult far = solve(cut_on_the_way({{14.6, -29.6}, {14.6, 9.2}}, {0, 2}), test::plane_options());
  ASSERT_EQ(far.failure, "");
  EXPECT_NEAR(far.history.back().reaction.x() / near.history.back().reaction.x(), 1, 0.02);
}

TEST(Dissection, KeepsMassAndEnergyInTime) {
  Model model = cut_on_the_way({{14.6, -0.5}, {14.6, 9.2}}, {0.6, 1.2});
  model.curve = LoadCurve({0, 0.5, 1.5}, {0, 1, 1}, LoadCurve::Join::smooth);
  SolveOptions options = test::plane_options();
  options.dynamics = Dynamics::transient;
  options.damping = 20;
  options.shape.basis = Basis::linear;
  options.max_steps = 200000;
  const SolveResult result = solve(model, options);
  EXPECT_EQ(result.failure, "") << "energies that do not balance are a failure";
  const HistoryRow& end = result.history.back();
  EXPECT_NEAR(end.external_work, end.strain_energy + end.kinetic_energy + end.dissipated_energy,
              0.03 * end.external_work);
  EXPECT_GT(result.measures.cut->advances, 5u);
}

TEST(Dissection, KeepsWhatRelaxingPointsRemember) {
  Model model = cut_on_the_way({{14.6, -0.5}, {14.6, 9.2}}, {0.2, 0.4});
  model.curve = LoadCurve({0, 0.2, 0.5}, {0, 1, 1}, LoadCurve::Join::smooth);
  model.materials[1].prony = {{0.6, 0.2}};
  SolveOptions options = test::plane_options();
  options.dynamics = Dynamics::transient;
  options.damping = 20;
  options.shape.basis = Basis::linear;
  const SolveResult result = solve(model, options);
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.measures.cut->advances, 5u);
  EXPECT_GT(result.history.back().reaction.x(), 0);
}

TEST(Cut, ThatCannotBeMadeIsRefusedWithAReason) {
  Model model = strip(1.2);
  model.cuts = {cut_path({{100, 100}, {120, 100}})};
  EXPECT_NE(refusal(model).find("does not meet the body"), std::string::npos);
  model.cuts = {{"sheet", test::sheet_along_x(4).vertices, test::sheet_along_x(4).facets, {}}};
  EXPECT_NE(refusal(model).find("in a plane problem give a path"), std::string::npos);
  model.cuts = {cut_path({{5, 10}, {15, 10}}, {1, 9})};
  EXPECT_NE(refusal(model).find("the load's curve ends"), std::string::npos);
  model.cuts = {cut_path({{14.6, -1}, {14.6, 21}})};
  EXPECT_NE(refusal(model).find("is not held"), std::string::npos) << "the pulled part may move along y";
  model.cuts = {cut_path({{-1, 18.6}, {1.6, 21}})};
  EXPECT_FALSE(refusal(model).empty()) << "a corner of one node";
}

}  // namespace brainshift::solve::dissection_test
