// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/surface/remesh.hpp"

#include <gtest/gtest.h>

#include "segmentation/geometry/surface_tree.hpp"
#include "segmentation/surface/surface_measures.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::segmentation::remesh_test {

double farthest_from(const Surface& body, const Points& places) {
  const SurfaceTree tree(body);
  double farthest = 0;
  for (const auto& place : places.rowwise()) {
    const Eigen::Vector3d x = place;
    farthest = std::max(farthest, (tree.nearest(x).position - x).norm());
  }
  return farthest;
}

TEST(Remesh, HasTheEdgesAskedForWithItsVerticesOnTheOldSurface) {
  const Surface body = test::sphere({-20, 30, 40}, 20, 3);
  for (const double edge : {2.0, 4.0, 8.0}) {
    const Surface again = remeshed(body, edge);
    EXPECT_GT(mean_edge_length(again), 0.8 * edge) << "shorter ones are collapsed";
    EXPECT_LT(mean_edge_length(again), 4.0 / 3.0 * edge) << "longer ones are split";
    EXPECT_LT(farthest_from(body, again.vertices), 1e-9);
    EXPECT_TRUE(measure(again).is_sound());
  }
}

TEST(Remesh, TurnsAClosedSurfaceOutward) {
  Surface body = test::sphere({-20, 30, 40}, 20, 2);
  const double enclosed = volume(body);
  body.triangles.col(0).swap(body.triangles.col(1));
  EXPECT_NEAR(volume(remeshed(body, 5)), enclosed, 0.05 * enclosed);
}

TEST(Remesh, LeavesAnOpenSurfaceOpen) {
  Surface body = test::sphere({-20, 30, 40}, 20, 2);
  body.triangles = body.triangles.topRows(body.triangles.rows() / 2).eval();
  const Surface again = remeshed(body, 5);
  EXPECT_GT(again.triangles.rows(), 0);
  EXPECT_FALSE(measure(again).closed);
}

}  // namespace brainshift::segmentation::remesh_test
