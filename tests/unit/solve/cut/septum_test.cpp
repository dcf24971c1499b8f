// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/septum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "segmentation/files/surface_file.hpp"
#include "solve/cut/cut_body.hpp"
#include "solve/shape/visibility.hpp"
#include "solve/solve.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::septum_test {

constexpr double side = 20, pressed = 2;

/// Two triangles in z = height that reach `beyond` mm out of a box of 20 mm, from x = -beyond to x = end.
Septum sheet(double height, double end = side + 3, double beyond = 3) {
  Septum septum{"sheet.vtp", {Points(4, 3), Triangles(2, 3)}};
  septum.sheet.vertices << -beyond, -beyond, height, end, -beyond, height, end, side + beyond, height, -beyond,
      side + beyond, height;
  septum.sheet.triangles << 0, 1, 2, 0, 2, 3;
  return septum;
}

/// A box on its base, its top pressed down between planes of symmetry at x = 0 and y = 0.
Model pressed_box() {
  Model model;
  model.cloud = test::irregular_box(9, side);
  model.conditions = test::all_free(model.cloud);
  model.cells = test::box_cells(Eigen::Vector3i::Constant(8), Eigen::Vector3d::Constant(side));
  model.materials[1] = {3000, 0.45, 1000};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    auto prescribed = model.conditions.displacement.row(a);
    for (int axis = 0; axis < 3; ++axis) {
      if (x[axis] == 0) {
        prescribed[axis] = 0;
      }
    }
    if (x.z() == side) {
      prescribed.z() = -pressed;
    }
  }
  return model;
}

SolveOptions fine() {
  SolveOptions options;
  options.tolerance = 1e-3;
  return options;
}

TEST(Septum, TakesAllOfAPressureOnOneSide) {
  Model model = pressed_box();
  model.septum = sheet(10.3);
  const SolveResult result = solve(model, fine());
  ASSERT_EQ(result.failure, "");
  const double share = pressed / (side - 10.3);
  double below = 0;
  std::vector<double> above;
  for (Eigen::Index a = 0; a < result.solution.positions.rows(); ++a) {
    const double z = result.solution.positions(a, 2);
    const double uz = result.solution.displacement(a, 2);
    if (z < 10.3) {
      below = std::max(below, result.solution.displacement.row(a).norm());
    } else {
      above.push_back(std::abs(uz + share * (z - 10.3)));  // evenly, between frictionless planes
    }
  }
  EXPECT_LT(below, 1e-9) << "the other side does not move at all";
  std::sort(above.begin(), above.end());
  EXPECT_LT(above[above.size() * 95 / 100], 0.02 * pressed);  // single nodes lift off where the sheet leaves the body
  ASSERT_TRUE(result.measures.septum);
  EXPECT_GT(result.measures.septum->touching_nodes, 0u);
  EXPECT_LT(result.measures.septum->largest_penetration, 0.03 * pressed);
  EXPECT_FALSE(result.measures.cut) << "nothing was cut";
}

TEST(Septum, LeavesTheTissueInOnePieceBeyondItsRim) {
  Model model = pressed_box();
  model.septum = sheet(10.3, 10);
  const SolveResult result = solve(model, fine());
  ASSERT_EQ(result.failure, "");
  double below = 0;
  for (Eigen::Index a = 0; a < result.solution.positions.rows(); ++a) {
    below = std::max(below, result.solution.positions(a, 2) < 10.3 ? -result.solution.displacement(a, 2) : 0);
  }
  EXPECT_GT(below, 0.1 * pressed);
}

TEST(Septum, GivesEachSideNodesOfItsOwnAndPartsThem) {
  Model model = pressed_box();
  model.septum = sheet(10.3);
  const CutBody body = cut_body(model);
  ASSERT_GT(body.septum_pairs, 30u);
  EXPECT_EQ(body.pairs.size(), body.septum_pairs);
  EXPECT_TRUE(body.cut_pairs().empty());
  for (const FacePair& pair : body.pairs) {
    EXPECT_TRUE(body.visibility->detour(body.cloud.positions.row(pair.above), body.cloud.positions.row(pair.below)));
  }
}

TEST(Septum, GoesWithACutContactAndDrainedFluid) {
  Model model = pressed_box();
  model.septum = sheet(6.3, 12);
  Septum upright = sheet(10.3, side / 2);
  upright.sheet.vertices.col(2).swap(upright.sheet.vertices.col(1));  // y = 10.3, from x = -3 to 10
  upright.sheet.vertices.col(2).array() += 16;                        // and from z = 13 up
  model.cuts = {{"cut.vtp", upright.sheet.vertices, upright.sheet.triangles, {}}};
  model.face_contact = true;
  const Eigen::Vector3d down(0, 0, -9.81);
  model.fluid = DrainedFluid{.gravity = down, .gravity_of_image = down, .level = -side / 2};
  const SolveResult result = solve(model, fine());
  ASSERT_EQ(result.failure, "");
  EXPECT_TRUE(result.measures.cut && result.measures.septum);
  EXPECT_GT(result.measures.cut->extent, 0);
  EXPECT_NEAR(result.measures.septum->area, 15 * 26, 1e-9);
}

/// Measured above the sheet alone, and prescribed on both sides.
TEST(Septum, EndsALoadThatWasMeasuredOnOneSide) {
  const NodeCloud cloud = test::irregular_box(5, side);
  Points prescribed = Points::Constant(cloud.positions.rows(), 3, 1);
  prescribed.row(0).setConstant(std::nan(""));
  Points measured(3, 3);
  measured << 5, 5, side, 15, 5, side, 10, 15, side;
  const Points ended = not_through(Visibility(facets_of(sheet(10.3))), measured, cloud, prescribed);
  for (Eigen::Index a = 1; a < cloud.positions.rows(); ++a) {
    EXPECT_EQ(ended.row(a).allFinite(), cloud.positions(a, 2) > 10.3) << cloud.positions.row(a);
  }
  EXPECT_TRUE(ended.row(0).array().isNaN().all());
  measured(2, 2) = 0;
  EXPECT_EQ(
      not_through(Visibility(facets_of(sheet(10.3))), measured, cloud, prescribed).bottomRows(prescribed.rows() - 1),
      prescribed.bottomRows(prescribed.rows() - 1))
      << "measured on both sides";
}

TEST(Septum, CountsTheNodesThatALoadTakesThroughIt) {
  const NodeCloud cloud = test::irregular_box(5, side);
  Points prescribed = Points::Constant(cloud.positions.rows(), 3, std::nan(""));
  EXPECT_EQ(moved_through(Visibility(facets_of(sheet(10.3))), cloud, prescribed), 0U);
  std::size_t through = 0;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    if (cloud.positions(a, 2) == side) {
      prescribed.row(a) << 0, 0, a % 2 == 0 ? -12.0 : -2.0;
      through += a % 2 == 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(moved_through(Visibility(facets_of(sheet(10.3))), cloud, prescribed), through);
}

TEST(Septum, IsRefusedWhereItPartsNothing) {
  Model model = pressed_box();
  model.septum = sheet(40);
  EXPECT_NE(test::refusal([&] {
              solve(model, fine());
            }).find("sheet.vtp: the septum does not meet the body; are its coordinates in mm"),
            std::string::npos);
}

TEST(Septum, IsRefusedWithoutTrianglesOrWithOneThatHasNoArea) {
  Septum none{"none.vtp", {}};
  EXPECT_EQ(test::refusal([&] { check_septum(none, false); }), "none.vtp: the septum has no triangle");
  Septum flat = sheet(5);
  flat.sheet.triangles.row(1) << 0, 2, 2;
  EXPECT_NE(test::refusal([&] { check_septum(flat, false); }).find("sheet.vtp: triangle 2 has no area"),
            std::string::npos);
  EXPECT_NE(test::refusal([&] { check_septum(sheet(5), true); }).find("leave it out of a plane problem"),
            std::string::npos);
}

TEST(Septum, IsReadFromASurfaceAndRefusesAnotherFile) {
  const test::ScratchFolder scratch;
  write_surface(scratch / "falx.vtp", sheet(5).sheet);
  const Septum read = read_septum(scratch / "falx.vtp");
  EXPECT_EQ(read.sheet.triangles, sheet(5).sheet.triangles);
  const auto text = scratch.write("text.vtp", "no surface\n");
  EXPECT_NE(test::refusal([&] { read_septum(text); }).find("text.vtp"), std::string::npos);
}

}  // namespace brainshift::solve::septum_test
