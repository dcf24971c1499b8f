// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_facets.hpp"

#include <gtest/gtest.h>

#include "solve/quadrature/cell_points.hpp"
#include "tests/unit/solve/cut_bodies.hpp"
#include "tests/unit/solve/sheets.hpp"

namespace brainshift::solve::cut_facets_test {

using test::cut_path;

constexpr double width = 40, height = 20, spacing = 2;

InsideBody rectangle() {
  const IntegrationPoints points = integration_points(test::rectangle_cells(20, 10, width, height), 4, nullptr, {1});
  return {points.positions, points.volume, true};
}

/// A square sheet 10 mm wide in z = 5 that is cut along x from time 0 to 1.
Cut timed_sheet() {
  const Surface sheet = test::square(6);
  Cut cut{"sheet", sheet.vertices, sheet.triangles, {}};
  for (const auto& v : sheet.vertices.rowwise()) {
    cut.time.push_back(v[0] / 10);
  }
  return cut;
}

TEST(CutFacets, OfAPathEndWhereItsTipIs) {
  const std::vector<Cut> cuts = {cut_path({{-5, 10}, {10, 10}, {20, 10}}, {0, 0.5, 1})};
  EXPECT_TRUE(facets_at(cuts, -0.5, rectangle(), spacing).empty());
  const CutFacets half = facets_at(cuts, 0.75, rectangle(), spacing);
  EXPECT_TRUE(half.planar);
  ASSERT_EQ(half.front.size(), 1U) << "the other end is outside";
  const Eigen::RowVector3d tip = half.vertices.row(half.front[0][0]);
  EXPECT_LE((tip - Eigen::RowVector3d(15, 10, 0)).norm(), 1e-12);
  EXPECT_EQ(half.front[0][0], half.front[0][1]);
  EXPECT_NEAR(extent(half), 20 + spacing, 1e-12) << "beyond its end outside";
}

TEST(CutFacets, OfAPathThroughTheBodyHaveNoFront) {
  const std::vector<Cut> cuts = {cut_path({{20, -1}, {20, 21}})};
  const CutFacets through = facets_at(cuts, 0, rectangle(), spacing);
  EXPECT_TRUE(through.front.empty());
  EXPECT_NEAR(extent(through), 22 + 2 * spacing, 1e-12) << "taken beyond the surface";
  const std::vector<Cut> inner = {cut_path({{10, 10}, {30, 10}})};
  EXPECT_EQ(facets_at(inner, 0, rectangle(), spacing).front.size(), 2U);
}

TEST(CutFacets, OfATearHangTogetherWithTheCutItStartsFrom) {
  const std::vector<Cut> cuts = {cut_path({{-1, 10}, {10, 10}}), cut_path({{10, 10}, {14, 12}})};
  const CutFacets joined = facets_at(cuts, 0, rectangle(), spacing);
  EXPECT_EQ(joined.vertices.rows(), 3);
  ASSERT_EQ(joined.front.size(), 1U) << "none where one goes on in the other";
  EXPECT_EQ(joined.vertices.row(joined.front[0][0]), Eigen::RowVector3d(14, 12, 0));
}

TEST(CutFacets, BetweenTwoTimesAreWhatIsCutBetweenThem) {
  const std::vector<Cut> path = {cut_path({{0, 0}, {3, 4}, {3, 10}}, {0, 0.5, 2})}, sheet = {timed_sheet()};
  for (const std::vector<Cut>& cuts : {path, sheet}) {
    const double last = last_time(cuts);
    double sum = 0, before = from_the_start;
    for (double time = 0; time < last + 0.1; time += 0.1) {
      sum += extent(facets_between(cuts, before, time));
      before = time;
    }
    EXPECT_NEAR(sum, extent(facets_between(cuts, from_the_start, last)), 1e-9);
  }
  EXPECT_NEAR(extent(facets_between(path, from_the_start, 2)), 11, 1e-12);
  EXPECT_NEAR(extent(facets_between(path, 0.25, 0.5)), 2.5, 1e-12);
  EXPECT_NEAR(extent(facets_between(sheet, from_the_start, 1)), 100, 1e-9);
  EXPECT_NEAR(extent(facets_between(sheet, from_the_start, 0.5)), 50, 10.01) << "whole triangles";
}

TEST(CutFacets, OfASheetHaveAFrontOnlyInsideTheBody) {
  const IntegrationPoints points = integration_points(test::box_cells({8, 10, 10}, {8, 10, 10}), 8, nullptr, {1});
  const InsideBody body(points.positions, points.volume, false);
  const std::vector<Cut> cuts = {timed_sheet()};
  const CutFacets half = facets_at(cuts, 0.45, body, 1);
  ASSERT_FALSE(half.front.empty());
  double length = 0;
  for (const auto& [a, b] : half.front) {
    const Eigen::RowVector3d middle = (half.vertices.row(a) + half.vertices.row(b)) / 2;
    EXPECT_GT(middle.y(), 0) << "not at the surface of the body";
    EXPECT_LT(middle.y(), 10);
    EXPECT_NEAR(middle.x(), 4, 1.01);
    length += std::abs(half.vertices(a, 1) - half.vertices(b, 1));
  }
  EXPECT_NEAR(length, 10, 1e-9) << "across the whole body";
  EXPECT_TRUE(facets_at(cuts, 1, body, 1).front.empty()) << "the sheet ends outside";
}

/// A rectangle of two triangles in y = 10 or x = 10, from one corner to the other.
Cut rectangle_sheet(int across, double from, double to, double low, double high) {
  Cut cut{"sheet", Points(4, 3), Triangles(2, 3), {}};
  const int along = 1 - across;
  cut.vertices.col(across).setConstant(10);
  cut.vertices.col(along) << from, to, to, from;
  cut.vertices.col(2) << low, low, high, high;
  cut.triangles << 0, 1, 2, 0, 2, 3;
  return cut;
}

InsideBody cube() {
  const IntegrationPoints points = integration_points(test::box_cells(10, 20), 8, nullptr, {1});
  return {points.positions, points.volume, false};
}

double front_length(const CutFacets& cut) {
  double length = 0;
  for (const auto& [a, b] : cut.front) {
    length += (cut.vertices.row(a) - cut.vertices.row(b)).norm();
  }
  return length;
}

/// However far the sheet sticks out of the body, and wherever the middle of its rim is.
TEST(CutFacets, OfASheetHaveAFrontAlongThePartOfALongRimThatIsInside) {
  for (const auto& [low, high] : {std::pair(-5.0, 25.0), {-5.0, 60.0}, {-300.0, 25.0}}) {
    const std::vector<Cut> cuts = {rectangle_sheet(1, -5, 12, low, high)};
    const CutFacets cut = facets_at(cuts, 0, cube(), spacing);
    EXPECT_NEAR(front_length(cut), 20, 1.5 * spacing) << low << " to " << high;
    for (const auto& [a, b] : cut.front) {
      EXPECT_EQ(cut.vertices(a, 0), 12);
      EXPECT_EQ(cut.vertices(b, 0), 12);
    }
    EXPECT_NEAR(extent(cut), 17 * (high - low), 1e-9 * extent(cut)) << "split, but the same";
  }
}

/// An L and a T of two sheets: exactly at each other, or one a little beyond the other or short of it.
TEST(CutFacets, OfSheetsThatMeetHaveNoFrontThere) {
  for (const double beyond : {0.0, 0.6, -0.6}) {
    const std::vector<Cut> l = {rectangle_sheet(1, -5, 10 + beyond, -5, 25),
                                rectangle_sheet(0, 10 - beyond, 25, -5, 25)};
    EXPECT_EQ(front_length(facets_at(l, 0, cube(), spacing)), 0) << beyond;
    const std::vector<Cut> t = {rectangle_sheet(1, -5, 10 + beyond, -5, 25), rectangle_sheet(0, -5, 25, -5, 25)};
    EXPECT_EQ(front_length(facets_at(t, 0, cube(), spacing)), 0) << beyond;
  }
  const std::vector<Cut> apart = {rectangle_sheet(1, -5, 8, -5, 25), rectangle_sheet(0, -5, 25, -5, 25)};
  EXPECT_NEAR(front_length(facets_at(apart, 0, cube(), spacing)), 20, 1.5 * spacing) << "a spacing of tissue is left";
}

TEST(CutFacets, OfTrianglesThatShareNoCornersHangTogether) {
  Cut whole = rectangle_sheet(1, -5, 12, -5, 25), parted = whole;
  parted.vertices = Points(whole.vertices({0, 1, 2, 0, 2, 3}, Eigen::all));
  parted.triangles << 0, 1, 2, 3, 4, 5;
  EXPECT_EQ(front_length(facets_at(std::vector{parted}, 0, cube(), spacing)),
            front_length(facets_at(std::vector{whole}, 0, cube(), spacing)));
}

TEST(CutFacets, OfPathsThatMeetHaveNoTipThere) {
  for (const double beyond : {0.2, 0.0, -0.4}) {
    const std::vector<Cut> cuts = {cut_path({{-5, 10}, {20 + beyond, 10}}), cut_path({{20, 10 - beyond}, {20, 25}})};
    EXPECT_TRUE(facets_at(cuts, 0, rectangle(), spacing).front.empty()) << beyond;
  }
  const std::vector<Cut> apart = {cut_path({{-5, 10}, {18, 10}}), cut_path({{20, -5}, {20, 25}})};
  EXPECT_EQ(facets_at(apart, 0, rectangle(), spacing).front.size(), 1U);
}

TEST(CutFacets, AdvanceByAStrideEachTime) {
  const std::vector<Cut> cuts = {cut_path({{0, 0}, {8, 0}, {8, 3}}, {0, 0.8, 2.3})};
  const std::vector<double> times = times_of_advance(cuts, 2);
  ASSERT_EQ(times.size(), 6U);
  EXPECT_EQ(times.back(), 2.3);
  double before = from_the_start;
  for (const double time : times) {
    EXPECT_NEAR(extent(facets_between(cuts, before, time)), time == times.back() ? 1 : 2, 1e-9);
    before = time;
  }
  const std::vector<Cut> at_once = {cut_path({{0, 0}, {8, 0}})};
  EXPECT_TRUE(times_of_advance(at_once, 2).empty());
  EXPECT_EQ(last_time(at_once), 0);
}

TEST(CutFacets, OfASheetAdvanceToItsLastTriangle) {
  const std::vector<Cut> cuts = {timed_sheet()};
  const std::vector<double> times = times_of_advance(cuts, 2.5);
  EXPECT_EQ(std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()), times.end()) << "ascending";
  EXPECT_NEAR(extent(facets_between(cuts, from_the_start, times.back())), 100, 1e-9);
  EXPECT_GE(times.size(), 3U);
  EXPECT_LE(times.size(), 5U);
}

}  // namespace brainshift::solve::cut_facets_test
