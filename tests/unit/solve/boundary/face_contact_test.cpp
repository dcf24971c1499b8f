// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/boundary/face_contact.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <numbers>

#include "solve/output/field_difference.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/cut_bodies.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::face_contact_test {

constexpr double side = 60;
constexpr double pressed = 6;  // mm

Cut path(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Cut cut;
  cut.name = "path";
  cut.vertices.resize(2, 3);
  cut.vertices << from.transpose(), to.transpose();
  return cut;
}

const Cut through = path({-5, 30, 0}, {65, 30, 0});
const Cut internal = path({15, 30, 0}, {45, 30, 0});

/// A square in plane strain whose top is moved; smooth: plates and the left side hold it along their normal only.
Model square(double top, bool smooth, int n = 25) {
  Model model;
  model.cloud = test::irregular_rectangle(n, n, side, side);
  model.conditions = test::all_free(model.cloud);
  model.cells = test::rectangle_cells(n - 1, n - 1, side, side);
  model.materials[1] = {3000, 0.45, 1000};
  model.plane = Plane::strain;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    auto prescribed = model.conditions.displacement.row(a);
    const bool low = x[1]<1e-9, high = x[1]> side - 1e-9;
    if (low || high) {
      prescribed[1] = high ? top : 0;
    }
    if (smooth ? x[0] < 1e-9 : low || high) {
      prescribed[0] = 0;
    }
  }
  return model;
}

Model with_cut(Model model, const Cut& cut, bool contact) {
  model.cuts = {cut};
  model.face_contact = contact;
  return model;
}

/// How far the faces overlap at most along a path that is y = 30, from one x to another, mm.
double overlap(const Solution& solution, double from, double to) {
  constexpr int places = 200;
  Points above(places + 1, 3), below(places + 1, 3);
  for (int i = 0; i <= places; ++i) {
    const double x = from + (to - from) * i / places;
    above.row(i) << x, 30 + 1e-3, 0;
    below.row(i) << x, 30 - 1e-3, 0;
  }
  return (displacement_at(solution, below) - displacement_at(solution, above)).col(1).maxCoeff();
}

double reaction(const SolveResult& result, int axis) {
  return result.history.back().reaction[axis];
}

TEST(FaceContact, CarriesWhatAnUncutBlockCarries) {
  for (const bool right_through : {true, false}) {
    const Model whole = square(-pressed, right_through);
    const Cut& cut = right_through ? through : internal;
    const double from = right_through ? 0 : 15, to = right_through ? side : 45;
    const SolveResult uncut = solve(whole, test::plane_options());
    const SolveResult touching = solve(with_cut(whole, cut, true), test::plane_options());
    const SolveResult apart = solve(with_cut(whole, cut, false), test::plane_options());
    ASSERT_TRUE(touching.measures.converged) << touching.failure;
    EXPECT_NEAR(reaction(touching, 1) / reaction(uncut, 1), 1, 0.01);
    EXPECT_LT(overlap(touching.solution, from, to), 0.01 * pressed);
    EXPECT_LT(touching.measures.cut->faces->largest_overlap, 0.005 * pressed);
    EXPECT_GE(touching.measures.cut->faces->touching_nodes, right_through ? 44u : 18u);
    EXPECT_GT(overlap(apart.solution, from, to), 0.8 * pressed);
    EXPECT_LT(reaction(apart, 1) / reaction(uncut, 1), 0.7);
  }
}

/// Its right end lies between two nodes of the surface.
TEST(FaceContact, HoldsTheCornersWhereACutLeavesTheBody) {
  const Model whole = square(-pressed, true);
  const Cut cut = path({-5, 30.5, 0}, {65, 30.5, 0});
  const SolveResult uncut = solve(whole, test::plane_options());
  const SolveResult touching = solve(with_cut(whole, cut, true), test::plane_options());
  ASSERT_TRUE(touching.measures.converged) << touching.failure;
  EXPECT_NEAR(reaction(touching, 1) / reaction(uncut, 1), 1, 0.015);
  EXPECT_LT(touching.measures.cut->faces->largest_overlap, 0.01 * pressed);
}

TEST(FaceContact, DoesNothingWhereTheFacesOpen) {
  for (const bool right_through : {true, false}) {
    const Model model = square(pressed, right_through);
    const Cut& cut = right_through ? through : internal;
    const SolveResult on = solve(with_cut(model, cut, true), test::plane_options());
    const SolveResult off = solve(with_cut(model, cut, false), test::plane_options());
    EXPECT_LT((on.solution.displacement - off.solution.displacement).cwiseAbs().maxCoeff(),
              1e-6);  // touched on the way
    EXPECT_EQ(on.measures.cut->faces->largest_overlap, 0);
  }
}

/// A block on a slope, pressed down by d, pushed against the slope by F: it slides by d/tan, and the plate feels F/tan.
TEST(FaceContact, SlidesWithoutFriction) {
  constexpr double d = 8, push = 3e-4, angle = std::numbers::pi / 6;
  const double slope = std::tan(angle);
  Model model = square(-d, true);
  model.conditions.force = Points::Zero(model.cloud.positions.rows(), 3);
  std::vector<Eigen::Index> pushed;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    model.conditions.displacement(a, 0) = x[1] < 1e-9 ? 0 : std::nan("");
    if (x[0] < 1e-9 && x[1] > side / 2) {
      pushed.push_back(a);
    }
  }
  for (const Eigen::Index a : pushed) {
    model.conditions.force(a, 0) = push / static_cast<double>(pushed.size());
  }
  const Cut cut = path({-5, 30 - 35 * slope, 0}, {65, 30 + 35 * slope, 0});
  const SolveResult result = solve(with_cut(model, cut, true), test::plane_options());
  ASSERT_TRUE(result.measures.converged) << result.failure;
  EXPECT_NEAR(reaction(result, 1) / (-push / slope), 1, 0.03);
  EXPECT_LT(result.measures.cut->faces->largest_overlap, 0.01 * d);
  const Points middle = displacement_at(result.solution, Points({{30, 45, 0}}));
  EXPECT_NEAR(middle(0, 0) / (-d / slope), 1, 0.05);
}

TEST(FaceContact, CarriesInSpace) {
  const Model whole = uniaxial(0.9, 9);
  Cut sheet;
  sheet.name = "sheet";
  sheet.vertices.resize(4, 3);
  sheet.vertices << -5, -5, 30, 65, -5, 30, 65, 65, 30, -5, 65, 30;
  sheet.triangles.resize(2, 3);
  sheet.triangles << 0, 1, 2, 0, 2, 3;
  const SolveResult uncut = solve(whole, {});
  const SolveResult touching = solve(with_cut(whole, sheet, true), {});
  ASSERT_TRUE(touching.measures.converged) << touching.failure;
  EXPECT_NEAR(reaction(touching, 2) / reaction(uncut, 2), 1, 0.006);
  EXPECT_LT(touching.measures.cut->faces->largest_overlap, 0.01 * pressed);
}

TEST(FaceContact, FollowsACutThatGoesOn) {
  const Model whole = square(-pressed, false);
  Cut cut = internal;
  cut.time = {0.2, 0.8};
  const SolveResult touching = solve(with_cut(whole, cut, true), test::plane_options());
  ASSERT_TRUE(touching.measures.converged) << touching.failure;
  EXPECT_GE(touching.measures.cut->advances, 5u);
  EXPECT_NEAR(reaction(touching, 1) / reaction(solve(whole, test::plane_options()), 1), 1, 0.01);
  EXPECT_LT(overlap(touching.solution, 15, 45), 0.015 * pressed);
}

TEST(FaceContact, TakesEnergyInATransientRunButGivesNone) {
  Model model = with_cut(square(-pressed, true, 13), through, true);
  model.curve = LoadCurve({0, 0.05, 0.3}, {0, 1, 1}, LoadCurve::Join::smooth);
  SolveOptions options = in_time();
  options.points_per_cell = 4;
  const SolveResult result = solve(model, options);
  ASSERT_TRUE(result.measures.converged) << result.failure;
  double largest_gain = 0, least_left = 1;
  for (const HistoryRow& row : result.history) {
    const double left = (row.strain_energy + row.kinetic_energy) / result.history.back().external_work;
    largest_gain = std::max(largest_gain, left - row.external_work / result.history.back().external_work);
    least_left = row.time > 0.05 ? std::min(least_left, left) : least_left;
  }
  EXPECT_LT(largest_gain, 0.005);
  EXPECT_GT(least_left, 0.8);
}

TEST(FaceContact, IsTheSameForAnyNumberOfThreads) {
  const Model model = with_cut(square(-pressed, true, 13), through, true);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const SolveResult one = solve(model, test::plane_options());
  omp_set_num_threads(3);
  const SolveResult three = solve(model, test::plane_options());
  omp_set_num_threads(threads);
  EXPECT_EQ(one.solution.displacement, three.solution.displacement);
}

}  // namespace brainshift::solve::face_contact_test
