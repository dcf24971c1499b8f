// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/adaptive_points.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <numeric>

#include "solve/quadrature/cell_points.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/domains.hpp"

namespace brainshift::solve::adaptive_points_test {

using test::Domain;
using test::domains;

constexpr double side = 40;
const std::vector<std::int32_t> tissues = {1, 2};

ShapeFunctions shape_of(const Domain& domain) {
  ShapeOptions options;
  options.planar = is_planar(domain.cells.kind);
  return {domain.cloud.positions, domain.cloud.spacing, options};
}

AdaptivePoints adaptive(const Domain& domain, double tolerance, int depth = 3, int points = 1) {
  return adaptive_points(domain.cells, shape_of(domain), {tolerance, depth, points}, nullptr, tissues);
}

double volume_of(const IntegrationPoints& points) {
  return std::accumulate(points.volume.begin(), points.volume.end(), 0.0);
}

/// Σ w ∂φ_a/∂X of all nodes.
Points integral(const AdaptivePoints& a, std::size_t nodes) {
  Points sum = Points::Zero(static_cast<Eigen::Index>(nodes), 3);
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    for (auto k = static_cast<std::size_t>(a.rows.begin[i]); k < static_cast<std::size_t>(a.rows.begin[i + 1]); ++k) {
      sum.row(a.rows.node[k]) += a.points.volume[i] * Eigen::Map<const Eigen::RowVector3d>(&a.rows.derivative[3 * k]);
    }
  }
  return sum;
}

TEST(AdaptivePoints, FillTheBodyAndCarryTheShapeFunctionsOfTheirPlaces) {
  for (const Domain& domain : domains(side)) {
    const AdaptivePoints a = adaptive(domain, 0.2);
    const double expected = is_planar(domain.cells.kind) ? side * side : side * side * side;
    EXPECT_NEAR(volume_of(a.points), expected, 1e-9 * expected) << domain.name;
    EXPECT_TRUE(std::is_sorted(a.points.cell.begin(), a.points.cell.end()));
    const ShapeRows again = shape_of(domain).evaluate(a.points.positions, true);
    EXPECT_EQ(a.rows.begin, again.begin) << domain.name;
    EXPECT_EQ(a.rows.node, again.node) << domain.name;
    EXPECT_EQ(a.rows.derivative, again.derivative) << domain.name;
  }
}

TEST(AdaptivePoints, SplitMoreAndIntegrateBetterTheSmallerTheTolerance) {
  for (const Domain& domain : domains(side)) {
    const bool planar = is_planar(domain.cells.kind);
    const Points exact = integral(adaptive(domain, 1e-6, planar ? 5 : 3), domain.cloud.size());
    std::size_t points = 0;
    double error = 1e9;
    for (const double tolerance : {1.0, 0.3, 0.1}) {
      const AdaptivePoints a = adaptive(domain, tolerance, planar ? 4 : 2);
      const double now = (integral(a, domain.cloud.size()) - exact).norm() / exact.norm();
      EXPECT_GE(a.points.size(), points) << domain.name;
      EXPECT_LE(now, error * 1.01) << domain.name;
      points = a.points.size();
      error = now;
    }
    EXPECT_LE(error, 0.06) << domain.name;
  }
}

TEST(AdaptivePoints, IntegratePolynomialsAsTheirGaussPointsDo) {
  for (const Domain& domain : domains(side)) {
    const double area = side * side, thickness = is_planar(domain.cells.kind) ? 1 : side;
    for (const int points : {1, most_points_per_cell(domain.cells.kind)}) {
      const AdaptivePoints a = adaptive(domain, 0.2, 3, points);
      double x = 0, xy = 0, xx = 0;
      for (std::size_t i = 0; i < a.points.size(); ++i) {
        const Eigen::RowVector3d at = a.points.positions.row(static_cast<Eigen::Index>(i));
        x += a.points.volume[i] * at[0];
        xy += a.points.volume[i] * at[0] * at[1];
        xx += a.points.volume[i] * at[0] * at[0];
      }
      const std::string which = domain.name + ", " + std::to_string(points);
      EXPECT_NEAR(volume_of(a.points), area * thickness, 1e-9 * area * thickness) << which;
      const double round = 1e-9 * area * area * thickness;
      const double quadratic = points == 1 ? 0.02 * area * area * thickness : round;  // one point: linear ones alone
      EXPECT_NEAR(x, area * side / 2 * thickness, round) << which;
      EXPECT_NEAR(xy, area * area / 4 * thickness, quadratic) << which;
      EXPECT_NEAR(xx, area * area / 3 * thickness, quadratic) << which;
      EXPECT_TRUE(points > 1 || std::abs(xx - area * area / 3 * thickness) > round) << which;
    }
  }
}

TEST(AdaptivePoints, ReachATighterToleranceWithFewerPointsTheMoreGaussPointsAPartHas) {
  for (const Domain& domain : {domains(side)[2], domains(side)[3]}) {
    const int most = most_points_per_cell(domain.cells.kind);
    std::size_t before = 0;
    for (const double tolerance : {0.3, 0.1, 0.03, 0.01}) {
      const AdaptivePoints many = adaptive(domain, tolerance, 5, most);
      EXPECT_GE(many.points.size(), before) << domain.name;
      before = many.points.size();
    }
    EXPECT_LT(2 * before, adaptive(domain, 0.01, 5, 1).points.size()) << domain.name;
  }
}

TEST(AdaptivePoints, MissTheToleranceTheLessTheDeeperTheyMayGo) {
  for (const Domain& domain : domains(side)) {
    double before = 1;
    for (const int depth : {1, 2, 3}) {
      const AdaptivePoints a = adaptive(domain, 0.15, depth);
      double capped = static_cast<double>(a.capped) / static_cast<double>(a.points.size());
      EXPECT_LE(capped, before) << domain.name;
      before = capped;
    }
    EXPECT_LT(before, 0.5) << domain.name;
  }
}

TEST(AdaptivePoints, StopAtTheDepthAndCountWhatMissedTheTolerance) {
  for (const Domain& domain : domains(side)) {
    const AdaptivePoints once = adaptive(domain, 1e-9, 1), coarse = adaptive(domain, 1e9, 3);
    const std::size_t parts = domain.cells.size() * (is_planar(domain.cells.kind) ? 4 : 8);
    EXPECT_EQ(once.points.size(), parts) << domain.name;
    EXPECT_EQ(once.capped, parts) << domain.name;
    EXPECT_EQ(coarse.points.size(), parts) << domain.name;
    EXPECT_EQ(coarse.capped, 0u) << domain.name;
  }
}

TEST(AdaptivePoints, OfACutCellKeepItsVolumeAndStayInside) {
  Domain domain = domains(side)[0];
  domain.cells.cut_index.assign(domain.cells.size(), -1);
  domain.cells.cut_index[0] = 0;
  const double edge = side / 4, octant = std::pow(edge / 2, 3);
  InsideOctants part{};
  for (int o = 0; o < 8; ++o) {  // x below three quarters of the cell; a sliver of one octant
    const bool whole = (o & 1) == 0;
    part.volume[o] = whole ? octant : (o == 7 ? 0.02 : 0.5) * octant;
    part.centroid[o][0] = whole ? edge / 4 : (o == 7 ? 0.505 : 0.625) * edge;
    part.centroid[o][1] = edge * ((o & 2) ? 0.75 : 0.25);
    part.centroid[o][2] = edge * ((o & 4) ? 0.75 : 0.25);
  }
  domain.cells.cut_parts = {part};
  const double inside = std::accumulate(part.volume, part.volume + 8, 0.0);
  domain.cells.inside_fraction[0] = inside / (8 * octant);
  const AdaptivePoints a = adaptive(domain, 1e-3, 2);
  EXPECT_NEAR(volume_of(a.points), side * side * side - 8 * octant + inside, 1e-9 * side * side * side);
  const ShapeRows again = shape_of(domain).evaluate(a.points.positions, true);
  EXPECT_EQ(a.rows.node, again.node);
  EXPECT_EQ(a.rows.derivative, again.derivative);
  const auto of_cut = static_cast<std::size_t>(std::count(a.points.cell.begin(), a.points.cell.end(), 0));
  EXPECT_EQ(of_cut, 4u * 8u + 3u);  // whole octants are split again, the others stay, the sliver is gone
  for (const AdaptivePoints& points : {a, adaptive(domain, 1e-3, 2, 8)}) {
    EXPECT_NEAR(volume_of(points.points), volume_of(a.points), 1e-9 * side * side * side);
    for (std::size_t i = 0; i < points.points.size(); ++i) {
      if (points.points.cell[i] == 0) {
        EXPECT_LT(points.points.positions(static_cast<Eigen::Index>(i), 0), 0.75 * edge);
      }
    }
  }
}

TEST(AdaptivePoints, AreTheSameForAnyNumberOfThreads) {
  const Domain domain = domains(side)[0];
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const AdaptivePoints one = adaptive(domain, 0.2);
  omp_set_num_threads(3);
  const AdaptivePoints three = adaptive(domain, 0.2);
  omp_set_num_threads(threads);
  EXPECT_EQ(one.points.positions, three.points.positions);
  EXPECT_EQ(one.rows.derivative, three.rows.derivative);
}

TEST(AdaptivePoints, RefuseMorePointsThanMemoryHolds) {
  const NodeCloud cloud = test::irregular_box(4, side);
  EXPECT_THROW(adaptive({"too many cells", cloud, test::box_cells(73, side)}, 0.1), std::invalid_argument);
}

TEST(AdaptivePoints, RefuseANumberOfPointsThatTheCellsDoNotTake) {
  const Domain domain = domains(side)[2];
  EXPECT_THROW(adaptive(domain, 0.1, 3, 8), std::invalid_argument);
}

}  // namespace brainshift::solve::adaptive_points_test
