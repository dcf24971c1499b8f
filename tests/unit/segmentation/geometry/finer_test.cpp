// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/finer.hpp"

#include <gtest/gtest.h>

#include "segmentation/surface/surface_measures.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::finer_test {

TEST(Finer, SplitsTrianglesAndKeepsTheSurface) {
  const Surface box = test::box({0, 0, 0}, {4, 8, 2}), split = finer(box, 1.5);
  EXPECT_LE(longest_edge(split), 1.5);
  EXPECT_GT(longest_edge(split), 0.75);
  EXPECT_NEAR(volume(split), volume(box), 1e-12);
  EXPECT_NEAR(area(split), area(box), 1e-12);
  EXPECT_TRUE(segmentation::measure(split).is_sound());
  EXPECT_EQ(finer(box, 9).triangles, box.triangles);
  EXPECT_EQ(finer(Surface(), 1).triangles.rows(), 0);
}

}  // namespace brainshift::finer_test
