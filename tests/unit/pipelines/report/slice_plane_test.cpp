// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/slice_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "segmentation/geometry/surface.hpp"

namespace brainshift::pipelines::slice_plane_test {

TEST(SlicePlane, ShowsThePatientsLeftOnTheRightWhateverTheImagesAxes) {
  ScalarImage image;
  image.geometry.size = {30, 30, 30};
  image.geometry.direction << 0, 0, -1, 0, 1, 0, -1, 0, 0;
  image.geometry.origin = {29, 0, 29};
  image.voxels.resize(image.geometry.voxel_count());
  for (int k = 0; k < 30; ++k) {
    for (int j = 0; j < 30; ++j) {
      for (int i = 0; i < 30; ++i) {
        image.at(i, j, k) = static_cast<float>(image.geometry.to_world({i * 1.0, j * 1.0, k * 1.0}).x());
      }
    }
  }
  const auto planes = anatomical_planes({15, 15, 15}, {2, 2, 2}, {28, 28, 28}, 2);
  const SlicePlane& axial = planes[0];
  const auto values = sample_slice(axial, image);
  for (const int x : {4, 20, 40}) {
    const double expected = axial.world({x + 0.5, 10.5}).x();
    EXPECT_NEAR(values[static_cast<std::size_t>(10 * axial.width + x)], expected, 1e-4);
  }
  EXPECT_EQ(axial.letters[1], 'L');
  EXPECT_GT(axial.right.x(), 0);  // LPS: x grows towards the patient's left
}

TEST(SlicePlane, AnImageEndsHalfAVoxelBeyondItsOutermostCentres) {
  ScalarImage image;
  image.geometry.size = {3, 3, 3};
  image.voxels.assign(27, 4);
  const SlicePlane axial = anatomical_planes({1, 1, 1}, {-2, -2, -2}, {4, 4, 4}, 10)[0];
  const auto values = sample_slice(axial, image);
  for (int x = 0; x < axial.width; ++x) {
    const double place = axial.world({x + 0.5, 30.5}).x();
    const float value = values[static_cast<std::size_t>(30 * axial.width + x)];
    EXPECT_EQ(std::isnan(value), place < -0.5 || place > 2.5) << place;
    EXPECT_TRUE(std::isnan(value) || value == 4) << place;
  }
}

TEST(SlicePlane, ThePixelsOfACutCubeHaveItsArea) {
  Surface cube;
  cube.vertices = Points(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    cube.vertices.row(corner) << 10 * (corner & 1), 10 * (corner >> 1 & 1), 10 * (corner >> 2 & 1);
  }
  cube.triangles = Triangles(12, 3);
  cube.triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5,
      3, 7, 5;
  for (const SlicePlane& plane : anatomical_planes({5, 5, 5}, {-5, -5, -5}, {15, 15, 15}, 4)) {
    const auto inside = pixels_inside(plane, discretise::Scanlines(cube));
    EXPECT_EQ(inside.size(), 40U * 40U) << plane.name;
    EXPECT_TRUE(centre_of(plane, inside.front()).isApprox(plane.world({20.5, 20.5}), 1e-12)) << plane.name;
  }
}

}  // namespace brainshift::pipelines::slice_plane_test
