// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/principal.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "solve/material/neo_hookean.hpp"

namespace brainshift::solve::principal_test {

Eigen::Vector3d sorted(Eigen::Vector3d values) {
  std::sort(values.begin(), values.end());
  return values;
}

TEST(PrincipalStretches, AreNumbersHoweverSmallTheStrain) {
  for (const double shear : {0.0, 1e-320, 1e-170, 1e-150, 1e-120, 1e-107, 1e-20, 1e-8}) {
    Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
    f(0, 1) = shear;
    EXPECT_LE((principal_stretches(f).array() - 1).abs().maxCoeff(), shear + 1e-15) << shear;
    EXPECT_TRUE(std::isfinite(largest_tangent(NeoHookean(Material{}), f, 0.0))) << shear;
  }
}

TEST(PrincipalStretches, AreThoseOfTheDeformation) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 1).normalized()).toRotationMatrix();
  const Eigen::Vector3d stretch(0.2, 1, 3);
  EXPECT_LE((sorted(principal_stretches(turn * stretch.asDiagonal() * turn)) - stretch).norm(), 1e-13);
  EXPECT_LE((principal_stretches(turn) - Eigen::Vector3d::Ones()).norm(), 1e-15);
}

}  // namespace brainshift::solve::principal_test
