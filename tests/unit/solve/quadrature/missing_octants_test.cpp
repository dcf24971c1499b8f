// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/missing_octants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "discretise/body/scanlines.hpp"
#include "discretise/discretise.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::missing_octants_test {

constexpr double radius = 30;

struct Ball : testing::Test {
  const Surface surface = test::sphere({3, -2, 5}, radius, 3);
  const discretise::Discretisation body = discretise::discretise(surface, nullptr, {.nodes = 300});
  const BackgroundCells& with = body.cells;

  /// As another program may write them.
  BackgroundCells fractions_alone() const {
    BackgroundCells cells = with;
    cells.cut_index.clear();
    cells.cut_parts.clear();
    return cells;
  }
};

/// Σ w x / Σ w.
Eigen::RowVector3d middle(const IntegrationPoints& points) {
  const Eigen::Map<const Eigen::VectorXd> w(points.volume.data(), static_cast<Eigen::Index>(points.size()));
  return (w.transpose() * points.positions) / w.sum();
}

/// Σ w |x − middle|² / Σ w.
double spread(const IntegrationPoints& points) {
  const Eigen::Map<const Eigen::VectorXd> w(points.volume.data(), static_cast<Eigen::Index>(points.size()));
  return (w.transpose() * (points.positions.rowwise() - middle(points)).rowwise().squaredNorm()).value() / w.sum();
}

std::size_t outside(const IntegrationPoints& points, const Surface& surface) {
  const discretise::Scanlines body(surface);
  std::size_t count = 0;
  for (const auto& x : points.positions.rowwise()) {
    count += body.inside(x.transpose()) ? 0 : 1;
  }
  return count;
}

TEST_F(Ball, HasNoPointOutsideOnceItsCellsHaveOctants) {
  const BackgroundCells without = fractions_alone();
  const IntegrationPoints before = integration_points(without, 8, nullptr, {1});
  EXPECT_GT(outside(before, surface), before.size() / 10);
  const std::optional<BackgroundCells> cells = with_missing_octants(without, surface, body.cloud);
  ASSERT_TRUE(cells);
  EXPECT_EQ(outside(integration_points(*cells, 8, nullptr, {1}), surface), 0U);
}

TEST_F(Ball, IsIntegratedAsByTheOctantsOfDiscretise) {
  const BackgroundCells without = fractions_alone();
  const auto made = integration_points(*with_missing_octants(without, surface, body.cloud), 8, nullptr, {1});
  const auto wanted = integration_points(with, 8, nullptr, {1}), whole = integration_points(without, 8, nullptr, {1});
  double volume = 0, wanted_volume = 0;
  for (const double w : made.volume) {
    volume += w;
  }
  for (const double w : wanted.volume) {
    wanted_volume += w;
  }
  EXPECT_NEAR(volume, wanted_volume, 1e-6 * wanted_volume);
  EXPECT_LT((middle(made) - middle(wanted)).norm(), 1e-3 * radius);
  EXPECT_NEAR(spread(made), spread(wanted), 2e-3 * spread(wanted));
  EXPECT_GT(std::abs(spread(whole) - spread(wanted)), 5 * std::abs(spread(made) - spread(wanted)));
}

/// The surface nodes say where outward is, the fractions how far.
TEST_F(Ball, IsIntegratedNearlyAsWellWithoutASurface) {
  const BackgroundCells without = fractions_alone();
  const auto made = integration_points(*with_missing_octants(without, std::nullopt, body.cloud), 8, nullptr, {1});
  const auto wanted = integration_points(with, 8, nullptr, {1}), whole = integration_points(without, 8, nullptr, {1});
  EXPECT_LT((middle(made) - middle(wanted)).norm(), 3e-3 * radius);
  EXPECT_NEAR(spread(made), spread(wanted), 5e-3 * spread(wanted));
  EXPECT_LT(outside(made, surface), outside(whole, surface) / 5);
}

/// A rectangle in squares of which the last column is cut at two fifths of its width.
TEST(CutSquares, GiveTheirQuadrantsAsTheFractionAndTheSurfaceNodesSay) {
  constexpr int n = 5;
  BackgroundCells cells = test::rectangle_cells(n, n, n, n);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    cells.inside_fraction[cell] = cells.vertices(cells.connectivity[4 * cell], 0) > n - 1.5 ? 0.4 : 1;
  }
  const NodeCloud cloud = test::irregular_rectangle(8, 8, n - 0.6, n);
  const auto points = integration_points(*with_missing_octants(cells, std::nullopt, cloud), 4, nullptr, {1});
  double volume = 0;
  for (const double w : points.volume) {
    volume += w;
  }
  EXPECT_NEAR(volume, n * (n - 0.6), 1e-9);
  EXPECT_LT(points.positions.col(0).maxCoeff(), n - 0.6);
  EXPECT_NEAR(middle(points)[0], (n - 0.6) / 2, 0.02);
}

TEST(CutSquares, StayWhereNothingTellsTheSurface) {
  BackgroundCells cells = test::rectangle_cells(2, 2, 2, 2);
  cells.inside_fraction[0] = 0.5;
  NodeCloud cloud = test::irregular_rectangle(4, 4, 2, 2);
  std::ranges::fill(cloud.on_surface, 0);
  EXPECT_FALSE(with_missing_octants(cells, std::nullopt, cloud));
}

TEST_F(Ball, StaysWhereNothingIsMissing) {
  EXPECT_FALSE(with_missing_octants(with, surface, body.cloud));
}

TEST_F(Ball, NeedsAClosedSurface) {
  Surface open = surface;
  open.triangles.conservativeResize(open.triangles.rows() - 1, 3);
  EXPECT_NE(test::refusal([&] { with_missing_octants(fractions_alone(), open, body.cloud); }), "");
}

}  // namespace brainshift::solve::missing_octants_test
