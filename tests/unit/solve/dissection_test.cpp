// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts of bodies: before they move and while they do.
#include <gtest/gtest.h>

#include <cmath>

#include "solve/cut/cut_body.hpp"
#include "solve/cut/matching.hpp"
#include "solve/field_difference.hpp"
#include "tests/unit/solve/cut_bodies.hpp"

namespace brainshift::solve {
namespace {

using test::cut_path;
using test::strip;
using test::strip_length;
using test::strip_width;

std::string refusal(const Model& model, const SolveOptions& options = test::plane_options()) {
  try {
    solve(model, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(Cut, AlongTheStretchChangesNothing) {
  Model model = strip(1.2);
  SolveOptions options = test::plane_options();
  options.consistency_defect = 1e-4;
  options.tolerance = 0.001;
  const SolveResult whole = solve(model, options);
  model.cuts = {cut_path({{8, 9.3}, {22, 9.3}})};
  const SolveResult cut = solve(model, options);
  const double of_free_edges =
      (whole.solution.displacement.col(0) - 0.2 * whole.solution.positions.col(0)).cwiseAbs().maxCoeff();
  EXPECT_LT(of_free_edges, 0.08);  // of 6 mm, with so few nodes
  EXPECT_LT(field_difference(whole.solution, cut.solution).largest, of_free_edges);
  EXPECT_NEAR(cut.history.back().reaction.x() / whole.history.back().reaction.x(), 1, 0.002);
}

TEST(Cut, ThroughTheBodyLeavesPartsThatMoveAlone) {
  Model model = strip(1.2);
  model.cuts = {cut_path({{14.6, -1}, {15.9, 21}})};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 0) == strip_length) {
      model.cloud.prescribed_displacement(a, 1) = 0;  // the part that is pulled off is held, too
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

TEST(CutBody, SplitsNodesOnThePathAndAddsPairsBetween) {
  Model model = strip(1.2);
  model.cloud.force = Points::Constant(model.cloud.positions.rows(), 3, 1e-3);
  model.cuts = {cut_path({{-1, 10}, {15, 10}})};
  const CutBody body = cut_body(model);
  ASSERT_GT(body.split, 0u);
  EXPECT_EQ(body.cloud.size(), model.cloud.size() + 2 * body.pairs.size() - body.split);
  EXPECT_NEAR(body.cloud.force.sum(), model.cloud.force.sum(), 1e-12);
  for (const FacePair& p : body.pairs) {
    EXPECT_GT(body.cloud.positions(p.above, 1), 10);
    EXPECT_LT(body.cloud.positions(p.below, 1), 10);
    EXPECT_NEAR((body.cloud.positions.row(p.above) - body.cloud.positions.row(p.below)).norm(), 4e-3, 1e-9);
    EXPECT_LT(p.place.x(), 15 - 0.99) << "half a spacing from the tip";
    EXPECT_NE(body.cloud.on_surface[static_cast<std::size_t>(p.above)], 0);
  }
  std::vector<double> along;
  for (const FacePair& p : body.pairs) {
    along.push_back(p.place.x());
  }
  std::sort(along.begin(), along.end());
  for (std::size_t i = 1; i < along.size(); ++i) {
    EXPECT_LT(along[i] - along[i - 1], 2 * 1.6);
    EXPECT_GT(along[i] - along[i - 1], 2 * 0.59);
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

TEST(Matching, CarriesALinearFieldOverExactly) {
  Model model = strip(1.2);
  const ShapeOptions options{.planar = true};
  const ShapeFunctions before(model.cloud.positions, model.cloud.spacing, options);
  model.cuts = {cut_path({{-1, 10}, {15, 10}})};
  const CutBody body = cut_body(model);
  const Points& nodes = body.cloud.positions;
  const ShapeFunctions after(nodes, body.cloud.spacing, options, body.visibility);
  std::vector<std::int32_t> near;
  for (Eigen::Index a = 0; a < nodes.rows(); ++a) {
    if (std::abs(nodes(a, 1) - 10) < 4 || a >= model.cloud.positions.rows()) {
      near.push_back(static_cast<std::int32_t>(a));
    }
  }
  const Points places = nodes(std::vector<Eigen::Index>(near.begin(), near.end()), Eigen::all);
  Matching match(near, body.cloud.size());
  match.agree_in_value(before.evaluate(places, true), after.evaluate(places, true));
  match.agree_in_gradient(before.evaluate(places, true), after.evaluate(places, true), 2);
  match.factorise();
  const Eigen::Matrix3d h = Eigen::Matrix3d{{0.1, 0.2, 0}, {-0.05, 0.3, 0}, {0, 0, 0}};
  NodalVectors u(4 * model.cloud.size(), 0.0);
  for (std::size_t a = 0; a < model.cloud.size(); ++a) {
    at(u, a).head<3>() = h * model.cloud.positions.row(static_cast<Eigen::Index>(a)).transpose();
  }
  const NodalVectors carried = match(u);
  for (const std::int32_t a : near) {
    EXPECT_LT((at(carried, static_cast<std::size_t>(a)).head<3>() - h * nodes.row(a).transpose()).norm(), 1e-6);
  }
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

}  // namespace
}  // namespace brainshift::solve
