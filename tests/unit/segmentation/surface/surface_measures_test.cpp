// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/surface/surface_measures.hpp"

#include <gtest/gtest.h>
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::surface_measures_test {

using namespace segmentation;

TEST(Surface, ADefectIsMeasuredAsWhatItIs) {
  Surface open = tetrahedron();
  open.triangles.conservativeResize(3, 3);
  EXPECT_FALSE(measure(open).closed);
  Surface inside_out = tetrahedron();
  inside_out.triangles.col(0).swap(inside_out.triangles.col(1));
  EXPECT_TRUE(measure(inside_out).closed);
  EXPECT_FALSE(measure(inside_out).outward);
  Surface two;  // two tetrahedra through each other
  two.vertices.resize(8, 3);
  two.vertices << tetrahedron().vertices, tetrahedron().vertices.array() + 2.0;
  two.triangles.resize(8, 3);
  two.triangles << tetrahedron().triangles, tetrahedron().triangles.array() + 4;
  EXPECT_TRUE(measure(two).closed);
  EXPECT_TRUE(measure(two).self_intersecting);
  expect_sound(measure(tetrahedron()));
}

}  // namespace brainshift::test::surface_measures_test
