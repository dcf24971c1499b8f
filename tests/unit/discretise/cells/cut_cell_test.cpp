// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cells/cut_cell.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::discretise::cut_cell_test {

using Eigen::Vector3d;
using test::box;
using test::sphere;

Vector3d centroid_of(const InsideOctants& octants, int octant) {
  return Vector3d(octants.centroid[octant][0], octants.centroid[octant][1], octants.centroid[octant][2]);
}

TEST(CutCell, WhollyInsideIsEightWholeOctants) {
  const InsidePart part = inside_part(Scanlines(box({0, 0, 0}, {10, 10, 10})), {2, 3, 4}, 4);
  EXPECT_NEAR(part.volume, 64, 1e-9);
  EXPECT_LT((part.centroid - Vector3d(4, 5, 6)).norm(), 1e-9);
  for (int octant = 0; octant < 8; ++octant) {
    const Vector3d corner(octant & 1, (octant >> 1) & 1, octant >> 2);  // x fastest, z slowest
    EXPECT_NEAR(part.octants.volume[octant], 8, 1e-9);
    EXPECT_LT((centroid_of(part.octants, octant) - (Vector3d(3, 4, 5) + 2 * corner)).norm(), 4.0 / 256);
  }
}

TEST(CutCell, WhollyOutsideIsNothing) {
  const InsidePart part = inside_part(Scanlines(box({0, 0, 0}, {10, 10, 10})), {11, 0, 0}, 4);
  EXPECT_EQ(part.volume, 0);
  EXPECT_EQ(std::accumulate(part.octants.volume, part.octants.volume + 8, 0.0), 0);
}

TEST(CutCell, CutByAPlaneAcrossXIsExact) {
  const InsidePart part = inside_part(Scanlines(box({-50, -50, -50}, {3.1, 50, 50})), {0, 0, 0}, 4);
  EXPECT_NEAR(part.volume, 16 * 3.1, 1e-9);
  EXPECT_LT((part.centroid - Vector3d(1.55, 2, 2)).norm(), 1e-9);
  EXPECT_NEAR(part.octants.volume[0], 8, 1e-9);
  EXPECT_NEAR(part.octants.volume[1], 4 * 1.1, 1e-9);
  EXPECT_NEAR(centroid_of(part.octants, 1).x(), 2.55, 1e-9);
}

TEST(CutCell, CutByAPlaneAlongTheLinesIsExactToATwoHundredAndFiftySixth) {
  for (const double height : {0.1, 0.9, 1.7, 2.35, 3.9}) {
    const Scanlines below_y(box({-50, -50, -50}, {50, height, 50})), below_z(box({-50, -50, -50}, {50, 50, height}));
    EXPECT_NEAR(inside_part(below_y, {0, 0, 0}, 4).volume, 16 * height, 64.0 / 256) << height;
    EXPECT_NEAR(inside_part(below_z, {0, 0, 0}, 4).volume, 16 * height, 64.0 / 256) << height;
  }
}

TEST(CutCell, TheVolumesOfItsOctantsAddUpAndTheirCentroidsHaveItsOwn) {
  const Scanlines body(sphere({0, 0, 0}, 5, 4));
  const InsidePart part = inside_part(body, {1, 2, 1}, 4);
  double volume = 0;
  Vector3d moment = Vector3d::Zero();
  for (int octant = 0; octant < 8; ++octant) {
    if (part.octants.volume[octant] > 0) {
      const Vector3d centroid = centroid_of(part.octants, octant);
      EXPECT_TRUE(body.inside(centroid)) << octant;
      volume += part.octants.volume[octant];
      moment += part.octants.volume[octant] * centroid;
    }
  }
  EXPECT_NEAR(volume, part.volume, 1e-9);
  EXPECT_LT((moment / volume - part.centroid).norm(), 0.01) << "but for what joins the largest";
}

TEST(CutCell, OfEightAroundABallHoldsAnEighthOfIt) {
  const Surface ball = sphere({0, 0, 0}, 5, 4);
  const Scanlines body(ball);
  double sum = 0;
  for (int octant = 0; octant < 8; ++octant) {
    const Vector3d low = 6 * (Vector3d(octant & 1, (octant >> 1) & 1, octant >> 2) - Vector3d::Ones());
    sum += inside_part(body, low, 6).volume;
  }
  EXPECT_NEAR(sum, volume(ball), 5e-3 * volume(ball));
}

TEST(CutCell, ASliverOfAnOctantJoinsTheLargest) {
  const InsidePart part = inside_part(Scanlines(box({-50, -50, -50}, {2.01, 50, 50})), {0, 0, 0}, 4);
  EXPECT_NEAR(part.volume, 16 * 2.01, 1e-9);
  EXPECT_NEAR(std::accumulate(part.octants.volume, part.octants.volume + 8, 0.0), part.volume, 1e-9);
  for (const int octant : {1, 3, 5, 7}) {
    EXPECT_EQ(part.octants.volume[octant], 0) << "half a per cent of it is inside";
  }
}

TEST(CutCell, TheCentroidOfAHollowPartMovesIntoTheBody) {
  const Surface outer = box({-10, -10, -10}, {10, 10, 10});
  Surface hollow = box({-1.8, -1.8, -1.8}, {1.8, 1.8, 1.8});
  hollow.triangles.col(0).swap(hollow.triangles.col(1));
  Surface shell{Points(16, 3), Triangles(24, 3)};
  shell.vertices << outer.vertices, hollow.vertices;
  shell.triangles << outer.triangles, hollow.triangles.array() + 8;
  const Scanlines body(shell);
  const InsidePart part = inside_part(body, {-2, -2, -2}, 4);
  EXPECT_NEAR(part.volume, 64 - 3.6 * 3.6 * 3.6, 1);
  EXPECT_TRUE(body.inside(part.centroid));
  for (int octant = 0; octant < 8; ++octant) {
    EXPECT_TRUE(body.inside(centroid_of(part.octants, octant))) << octant;
  }
}

}  // namespace brainshift::discretise::cut_cell_test
