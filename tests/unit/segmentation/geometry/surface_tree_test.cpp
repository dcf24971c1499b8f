// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/surface_tree.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::surface_tree_test {

using test::box;

/// A square of side 4 in the plane z = 1 with a flat triangle before its two.
Surface square() {
  Surface sheet{Points(4, 3), Triangles(3, 3)};
  sheet.vertices << 0, 0, 1, 4, 0, 1, 4, 4, 1, 0, 4, 1;
  sheet.triangles << 0, 1, 1, 0, 1, 2, 0, 2, 3;
  return sheet;
}

TEST(SurfaceTree, PlacesOutsideABoxAreNearestToWhereTheyAreCutOff) {
  const Eigen::Vector3d low(1, 2, 3), high(3, 5, 9);
  const Surface body = box(low, high);
  const SurfaceTree tree(body);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> within(-10, 20);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d x(within(random), within(random), within(random));
    const Eigen::Vector3d expected = x.cwiseMax(low).cwiseMin(high);
    if (expected == x) {
      continue;
    }
    const SurfacePlace place = tree.nearest(x);
    EXPECT_LT((place.position - expected).norm(), 1e-12);
    EXPECT_FALSE(place.on_rim) << "a closed surface has none";
    const Triangle nearest = triangle(body, place.triangle);
    EXPECT_NEAR(nearest.area_vector().dot(place.position - nearest.a), 0, 1e-12) << "in the triangle's plane";
    // At right angles to the face, or half way between those that meet in the edge or corner.
    EXPECT_TRUE(place.normal.isApprox((x - expected).cwiseSign().normalized(), 1e-12)) << place.normal.transpose();
  }
}

TEST(SurfaceTree, WhereTwoSheetsTouchTheNormalIsThatOfOneOfThem) {
  Surface sheets = square();
  sheets.triangles << 0, 1, 2, 0, 2, 3, 0, 2, 1;  // the first once more, turned
  const Eigen::Vector3d normal = SurfaceTree(sheets).nearest({5, -1, 1}).normal;
  EXPECT_TRUE(normal.isApprox(Eigen::Vector3d(0, 0, normal.z() > 0 ? 1 : -1)));
}

TEST(SurfaceTree, KnowsTheRimOfAnOpenSurface) {
  const SurfaceTree tree(square());
  const auto on_rim = [&](double x, double y) { return tree.nearest({x, y, 2}).on_rim; };
  EXPECT_FALSE(on_rim(3, 1));
  EXPECT_FALSE(on_rim(2, 2)) << "between the two triangles";
  EXPECT_TRUE(on_rim(5, 1));
  EXPECT_TRUE(on_rim(2, -3));
  EXPECT_TRUE(on_rim(5, 5)) << "a corner";
  EXPECT_TRUE(on_rim(-1, 5));
}

TEST(SurfaceTree, NumbersTrianglesAsTheSurfaceDoesAndLeavesOutFlatOnes) {
  const SurfaceTree tree(square());
  EXPECT_EQ(tree.nearest({3, 1, 0}).triangle, 1);
  EXPECT_EQ(tree.nearest({1, 3, 0}).triangle, 2);
  EXPECT_EQ(tree.nearest({1, 3, 0}).position, Eigen::Vector3d(1, 3, 1));
  EXPECT_EQ(tree.nearest({1, 3, 0}).normal, Eigen::Vector3d(0, 0, 1));
}

TEST(SurfaceTree, OfASurfaceWithoutAreaIsRefused) {
  Surface sheet = square();
  sheet.triangles = sheet.triangles.topRows(1).eval();
  EXPECT_NE(test::refusal([&] { SurfaceTree{sheet}; }).find("no triangle with an area"), std::string::npos);
  EXPECT_THROW(SurfaceTree{Surface{}}, std::invalid_argument);
}

}  // namespace brainshift::surface_tree_test
