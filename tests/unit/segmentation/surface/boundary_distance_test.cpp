// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/surface/extract.hpp"

#include <gtest/gtest.h>
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::boundary_distance_test {

using namespace segmentation;

const Eigen::Vector3d centre(100.0, -50.0, 30.0);

TEST(Surface, DistanceToTheLabelsBoundaryIsThatOfTheVoxelsFaces) {
  const auto geometry = grid_around(centre, 31, Eigen::Vector3d::Ones(), oblique());
  Mask mask{geometry, std::vector<std::uint8_t>(geometry.voxel_count())};
  for (int k = 5; k < 26; ++k) {
    for (int j = 5; j < 26; ++j) {
      for (int i = 5; i < 26; ++i) {
        mask.at(i, j, k) = 1;
      }
    }
  }
  Surface plane;  // a triangle beside the face at index 25.5; farther than 7.5 voxels is not asked for
  for (const double away : {4.0, 0.25, 1000.0}) {
    plane.vertices.resize(3, 3);
    plane.vertices.row(0) = geometry.to_world({10, 10, 25.5 + away}).transpose();
    plane.vertices.row(1) = geometry.to_world({20, 10, 25.5 + away}).transpose();
    plane.vertices.row(2) = geometry.to_world({10, 20, 25.5 + away}).transpose();
    plane.triangles.resize(1, 3);
    plane.triangles << 0, 1, 2;
    EXPECT_NEAR(boundary_distance_95(plane, mask), std::min(away, 7.5), 1e-9);
  }
}

}  // namespace brainshift::test::boundary_distance_test
