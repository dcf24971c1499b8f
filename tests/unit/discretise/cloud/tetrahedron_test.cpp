// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/tetrahedron.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace brainshift::discretise::tetrahedron_test {

/// Of edge 2√2, at every other corner of a cube.
TetrahedronCorners regular() {
  TetrahedronCorners x;
  x << 1, 1, 1, -1, 1, -1, 1, -1, -1, -1, -1, 1;
  return x;
}

TEST(Tetrahedron, ARegularOneHasQualityOneWhateverItsSizeAndPlace) {
  for (const double size : {1e-3, 1.0, 50.0}) {
    TetrahedronCorners x = size * regular();
    x.rowwise() += Eigen::RowVector3d(3, -4, 5);
    EXPECT_NEAR(shape_quality(x), 1, 1e-9);
    EXPECT_NEAR(mean_edge(x), size * std::sqrt(8.0), 1e-9 * size);
    EXPECT_NEAR(volume_of(x), 8.0 / 3.0 * size * size * size, 1e-9 * size * size * size);
  }
}

TEST(Tetrahedron, IsPositiveInTheOrderOfVtk) {
  TetrahedronCorners x;
  x << 0, 0, 0, 3, 0, 0, 0, 4, 0, 0, 0, 5;
  EXPECT_NEAR(volume_of(x), 10, 1e-12);
  x.row(0).swap(x.row(1));
  EXPECT_NEAR(volume_of(x), -10, 1e-12);
  EXPECT_NEAR(mean_edge(x), 5, 1e-12) << "of 3, 4, 5, √25, √34 and √41";
  EXPECT_LT(shape_quality(x), 0);
}

TEST(Tetrahedron, GetsWorseAsItGetsFlatter) {
  double before = shape_quality(regular());
  for (const double height : {0.7, 0.4, 0.1, 0.0}) {
    TetrahedronCorners x = regular();
    x.col(2) *= height;
    EXPECT_LT(shape_quality(x), before);
    before = shape_quality(x);
  }
  EXPECT_EQ(before, 0);
}

TEST(Tetrahedron, HasTheNodesItNamesForCorners) {
  Points nodes(5, 3);
  nodes << 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14;
  const TetrahedronCorners x = corners_of(nodes, {4, 0, 3, 1});
  EXPECT_EQ(x.row(0), nodes.row(4));
  EXPECT_EQ(x.row(1), nodes.row(0));
  EXPECT_EQ(x.row(2), nodes.row(3));
  EXPECT_EQ(x.row(3), nodes.row(1));
}

}  // namespace brainshift::discretise::tetrahedron_test
