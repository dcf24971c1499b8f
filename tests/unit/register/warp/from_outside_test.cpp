// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/warp/from_outside.hpp"

#include <gtest/gtest.h>

#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::from_outside_test {

using namespace builders;

TEST(ShareFromOutside, CountsWhatComesFromBothSidesOfTheImage) {
  const ImageGeometry g = grid({20, 18, 16}, {1.5, 1.5, 1.5});
  for (const double x : {-3.0, 3.0}) {  // two voxels
    const VectorImage back = field(g, [&](const Eigen::Vector3d&) { return Eigen::Vector3d(x, 0, 0); });
    EXPECT_NEAR(share_from_outside(g, back, g), 2.0 / 20, 1e-12);
  }
}

}  // namespace brainshift::registration::from_outside_test
