// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/shape/surface_normals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solve/body/ordered_cloud.hpp"
#include "solve/quadrature/cell_boundary.hpp"
#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::surface_normals_test {

constexpr double side = 60;

std::vector<Surface> one(const Surface& surface) {
  return {surface};
}

NodeCloud on_surface_of_box() {
  const NodeCloud cloud = test::irregular_box(7, side);
  return subset(cloud, surface_nodes(cloud));
}

TEST(SurfaceNormals, OfABoxAreThoseOfTheFacesThatMeet) {
  const NodeCloud nodes = on_surface_of_box();
  const SurfaceNormals normals =
      surface_normals(one(cell_boundary(test::box_cells(4, side))), nodes.positions, nodes.spacing);
  ASSERT_EQ(normals.rank.size(), nodes.size());
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const auto x = nodes.positions.row(static_cast<Eigen::Index>(a)).array();
    const Eigen::Array3d on_face = ((x < 1e-9) || (x > side - 1e-9)).cast<double>().transpose();
    EXPECT_EQ(normals.rank[a], static_cast<int>(on_face.sum())) << x;
    const auto along = normals.direction[a].leftCols(normals.rank[a]);
    EXPECT_LE(((along * along.transpose()).diagonal().array() - on_face).abs().maxCoeff(), 1e-12) << x;
  }
}

/// Rank 1 everywhere, though triangles turn by a few degrees at every edge.
TEST(SurfaceNormals, OfASphereAreItsRadii) {
  constexpr double radius = 40;
  const Surface ball = test::sphere(Eigen::Vector3d::Zero(), radius, 3);
  const Points nodes = test::sphere(Eigen::Vector3d::Zero(), radius, 2).vertices;
  const auto count = static_cast<std::size_t>(nodes.rows());
  const std::vector<double> spacing(count, radius * std::sqrt(4 * std::numbers::pi / static_cast<double>(count)));
  const SurfaceNormals normals = surface_normals(one(ball), nodes, spacing);
  for (std::size_t a = 0; a < spacing.size(); ++a) {
    EXPECT_EQ(normals.rank[a], 1);
    const Eigen::Vector3d radial = nodes.row(static_cast<Eigen::Index>(a)).transpose() / radius;
    EXPECT_GE(std::abs(normals.direction[a].col(0).dot(radial)), std::cos(0.1));
  }
}

/// Four nodes twice, in the middle of a box and across it, as on the two faces of a cut.
TEST(SurfaceNormals, OfBothFacesOfACutAreTheSame) {
  Points nodes(8, 3);
  for (Eigen::Index a = 0; a < 8; ++a) {
    nodes.row(a) << side / (a % 2 == 0 ? 3 : 1.5), side / (a / 2 % 2 == 0 ? 3 : 1.5), side / 2;
  }
  Surface cut{Points(3, 3), Triangles(1, 3)};
  cut.vertices << 0, 0, side / 2, 2 * side, 0, side / 2, 0, 2 * side, side / 2;
  cut.triangles << 0, 1, 2;
  const std::vector<Surface> surfaces = {test::box(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(side)), cut};
  const SurfaceNormals normals = surface_normals(surfaces, nodes, std::vector<double>(8, side / 6));
  for (std::size_t a = 0; a < 8; ++a) {
    EXPECT_EQ(normals.rank[a], 1);
    EXPECT_NEAR(std::abs(normals.direction[a](2, 0)), 1, 1e-12);
  }
}

TEST(SurfaceNormals, AreUnknownFarFromTheBoundary) {
  Points nodes(2, 3);
  nodes << 0, side / 2, side / 2,  //
      10 * side, 0, 0;
  const std::vector<double> spacing(2, side / 6);
  const SurfaceNormals normals = surface_normals(one(cell_boundary(test::box_cells(4, side))), nodes, spacing);
  EXPECT_EQ(normals.rank[0], 1);
  EXPECT_EQ(normals.rank[1], 3);
}

}  // namespace brainshift::solve::surface_normals_test
