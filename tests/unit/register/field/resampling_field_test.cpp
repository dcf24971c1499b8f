// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/resampling_field.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "register/registration.hpp"
#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::resampling_field_test {

using namespace builders;

constexpr double rounding = 2.2e-4;  // of the stored displacement: half of 1/4096 mm in each component

TEST(ResamplingField, TakesBackWhatTheForwardFieldDid) {
  const RegisterMeasures m = register_images(head(sinking), {}).measures;
  EXPECT_GT(m.brain_voxels, 9000U);
  EXPECT_LE(m.inverse_mean, 0.05);
  EXPECT_LE(m.inverse_999, 0.5);
  EXPECT_EQ(m.not_inverted, 0U);
}

TEST(ResamplingField, OfAShiftIsTheShiftBack) {
  const Eigen::Vector3d shift(2, -1, 3);
  const RegisterInput input = head([&](const Eigen::Vector3d&) { return shift; });
  const Registration result = register_images(input, {});
  double largest = 0;
  for_each_voxel(input.t1.geometry, [&](const Eigen::Vector3d& y, std::size_t v) {
    if ((y - shift - centre).norm() < radius - 3) {
      largest = std::max(largest, (at(result.resampling, v) + shift).norm());
    }
  });
  EXPECT_LT(largest, 2e-4 + 2 * rounding);  // where Newton's method stops
}

}  // namespace brainshift::registration::resampling_field_test
