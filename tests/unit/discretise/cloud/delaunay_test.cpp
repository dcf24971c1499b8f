// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/delaunay.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <set>

#include "discretise/cloud/random.hpp"
#include "discretise/cloud/tetrahedron.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::discretise::delaunay_test {

/// The corners of a box of 10 mm far from the origin, then points at random in it.
Points some_points(Eigen::Index count) {
  Points points(8 + count, 3);
  points.topRows(8) = test::box({0, 0, 0}, {10, 10, 10}).vertices;
  Random random(4);
  for (Eigen::Index i = 8; i < points.rows(); ++i) {
    points.row(i) << 10 * random.uniform(), 10 * random.uniform(), 10 * random.uniform();
  }
  points.rowwise() += Eigen::RowVector3d(200, -300, 50);
  return points;
}

TEST(Delaunay, FillsTheHullWithPositiveTetrahedraOfAllPoints) {
  const Points points = some_points(80);
  double volume = 0;
  std::set<std::int32_t> used;
  for (const auto& tetrahedron : delaunay_tetrahedra(points)) {
    const double of_one = volume_of(corners_of(points, tetrahedron));
    EXPECT_GE(of_one, 0);
    volume += of_one;
    used.insert(tetrahedron.begin(), tetrahedron.end());
  }
  EXPECT_NEAR(volume, 1000, 1e-8);
  EXPECT_EQ(used.size(), 88U);
}

TEST(Delaunay, HasNoPointInTheSphereOfATetrahedron) {
  const Points points = some_points(40);
  for (const auto& tetrahedron : delaunay_tetrahedra(points)) {
    const TetrahedronCorners x = corners_of(points, tetrahedron);
    const Eigen::Matrix3d edges = 2 * (x.bottomRows<3>().rowwise() - x.row(0));
    if (std::abs(edges.determinant()) < 1e-6) {
      continue;  // four points of a side of the box
    }
    const Eigen::Vector3d centre = edges.inverse() * (x.bottomRows<3>().rowwise() - x.row(0)).rowwise().squaredNorm();
    const auto distance = (points.rowwise() - (x.row(0) + centre.transpose())).rowwise().norm();
    EXPECT_GE(distance.minCoeff(), centre.norm() - 1e-6);
  }
}

TEST(Delaunay, OfTheSamePointsIsTheSameList) {
  EXPECT_EQ(delaunay_tetrahedra(some_points(200)), delaunay_tetrahedra(some_points(200)));
}

TEST(Delaunay, OfPointsInAPlaneOrTooFewIsNone) {
  Points flat = some_points(20);
  flat.col(2).setConstant(3);
  EXPECT_TRUE(delaunay_tetrahedra(flat).empty());
  EXPECT_TRUE(delaunay_tetrahedra(Points(some_points(0).topRows(3))).empty());
  EXPECT_TRUE(delaunay_tetrahedra(Points(0, 3)).empty());
}

TEST(Delaunay, LeavesOutAPointThatIsThereAlready) {
  Points points = some_points(10);
  points.row(17) = points.row(9);
  std::set<std::int32_t> used;
  for (const auto& tetrahedron : delaunay_tetrahedra(points)) {
    used.insert(tetrahedron.begin(), tetrahedron.end());
  }
  EXPECT_EQ(used.size(), 17U);
  EXPECT_EQ(used.count(9) + used.count(17), 1U);
}

}  // namespace brainshift::discretise::delaunay_test
