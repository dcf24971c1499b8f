// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/jacobian.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::jacobian_test {

using namespace builders;

TEST(Jacobian, OfAnAffineMapIsItsDeterminantOnAnObliqueLeftHandedGrid) {
  Eigen::Matrix3d slope;
  slope << 0.2, -0.1, 0.3, 0.1, -0.25, 0.2, -0.15, 0.05, 0.1;
  const Eigen::Matrix3d left_handed = oblique() * Eigen::Vector3d(1, -1, 1).asDiagonal();
  const ImageGeometry g = grid({9, 8, 7}, {0.7, 1.3, 2.9}, left_handed);
  const ScalarImage j = jacobian(field(g, [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return slope * x; }));
  const double expected = (Eigen::Matrix3d::Identity() + slope).determinant();
  for (const float value : j.voxels) {
    ASSERT_NEAR(value, expected, 2e-5);
  }
}

}  // namespace brainshift::registration::jacobian_test
