// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::surface_test {

using test::box;
using test::sphere;

TEST(SurfaceGeometry, ATrianglesAreaVectorIsItsNormalAsLongAsItsArea) {
  const Triangle t{{1, 1, 1}, {4, 1, 1}, {1, 5, 1}};
  EXPECT_EQ(t.area_vector(), Eigen::Vector3d(0, 0, 6));
  EXPECT_EQ((Triangle{t.a, t.c, t.b}).area_vector(), Eigen::Vector3d(0, 0, -6));
  EXPECT_TRUE(t.centroid().isApprox(Eigen::Vector3d(2, 7.0 / 3.0, 1)));
}

TEST(SurfaceGeometry, ATriangleHasItsCornersInTheirOrder) {
  const Surface body = box({0, 0, 0}, {1, 2, 3});
  const Triangle t = triangle(body, 2);
  EXPECT_EQ(t.a.transpose(), body.vertices.row(4));
  EXPECT_EQ(t.b.transpose(), body.vertices.row(5));
  EXPECT_EQ(t.c.transpose(), body.vertices.row(6));
}

TEST(SurfaceGeometry, VolumeAndAreaOfABoxDoNotDependOnWhereItLies) {
  const Eigen::Vector3d edges(2, 3, 5);
  for (const Eigen::Vector3d& low :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(900, -700, 60)}) {
    Surface body = box(low, low + edges);
    EXPECT_NEAR(volume(body), 30, 1e-6);
    EXPECT_NEAR(area(body), 62, 1e-9);
    body.triangles.col(0).swap(body.triangles.col(1));
    EXPECT_NEAR(volume(body), -30, 1e-6) << "inside out";
    EXPECT_NEAR(area(body), 62, 1e-9);
  }
}

TEST(SurfaceGeometry, ExtentAndFlatnessAreThoseOfTheTriangles) {
  Surface body = box({900, -700, 60}, {902, -697, 65});
  body.vertices.conservativeResize(body.vertices.rows() + 1, 3);
  body.vertices.bottomRows<1>() << 1e9, 0, 0;  // of no triangle
  EXPECT_NEAR(extent(body), 5, 1e-9);
  EXPECT_FALSE(is_flat(body));
  Surface sheet = body;
  sheet.triangles.conservativeResize(2, 3);
  EXPECT_TRUE(is_flat(sheet));
  sheet.triangles.setConstant(3);
  EXPECT_TRUE(is_flat(sheet));
  EXPECT_EQ(extent(sheet), 0);
  EXPECT_TRUE(is_flat({}));
}

TEST(SurfaceGeometry, VolumeAndAreaOfATurnedBodyAreTheSame) {
  Surface body = sphere({3, 4, 5}, 10, 2);
  const double before = volume(body), area_before = area(body);
  const Eigen::AngleAxisd turn(1.1, Eigen::Vector3d(1, -2, 3).normalized());
  body.vertices = (body.vertices * turn.toRotationMatrix().transpose()).eval();
  EXPECT_NEAR(volume(body), before, 1e-9 * before);
  EXPECT_NEAR(area(body), area_before, 1e-9 * area_before);
}

TEST(SurfaceGeometry, VolumeAndAreaOfFinerSpheresApproachTheBalls) {
  constexpr double radius = 10;
  const double exact_volume = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
  const double exact_area = 4 * std::numbers::pi * radius * radius;
  double missing_before = exact_volume;
  for (const int rounds : {1, 2, 3, 4}) {
    const Surface body = sphere({-20, 30, 40}, radius, rounds);
    const double missing = exact_volume - volume(body);
    EXPECT_GT(missing, 0);
    EXPECT_LT(missing, 0.3 * missing_before) << "of second order in the edges";
    EXPECT_LT(area(body), exact_area);
    missing_before = missing;
  }
  EXPECT_NEAR(area(sphere({-20, 30, 40}, radius, 4)), exact_area, 0.005 * exact_area);
}

TEST(SurfaceGeometry, VertexNormalsOfAClosedSurfaceAddUpToNothing) {
  const Points normals = vertex_normals(box({1, 2, 3}, {4, 6, 9}));
  EXPECT_LT(normals.colwise().sum().norm(), 1e-12);
}

TEST(SurfaceGeometry, VertexNormalsOfASpherePointAwayFromItsCentre) {
  const Eigen::Vector3d centre(-20, 30, 40);
  const Surface body = sphere(centre, 10, 3);
  const Points normals = vertex_normals(body);
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const Eigen::RowVector3d outward = (body.vertices.row(v) - centre.transpose()).normalized();
    EXPECT_GT(normals.row(v).normalized().dot(outward), 0.9999);
  }
  EXPECT_NEAR(normals.rowwise().norm().sum(), 3 * area(body), 0.02 * area(body));
}

TEST(SurfaceGeometry, AVertexWithoutTrianglesHasNoNormal) {
  Surface sheet{Points(4, 3), Triangles(1, 3)};
  sheet.vertices << 0, 0, 0, 2, 0, 0, 0, 2, 0, 9, 9, 9;
  sheet.triangles << 0, 1, 2;
  const Points normals = vertex_normals(sheet);
  EXPECT_EQ(normals.row(1), Eigen::RowVector3d(0, 0, 2));
  EXPECT_EQ(normals.row(3), Eigen::RowVector3d(0, 0, 0));
}

}  // namespace brainshift::surface_test
