// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/place_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace brainshift::registration::place_map_test {

TEST(PlaceMap, OfAnAffineMapTheInverseIsExact) {
  Eigen::Affine3d affine = Eigen::Affine3d::Identity();
  affine.translate(Eigen::Vector3d(12, -3, 5)).rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()));
  affine.scale(Eigen::Vector3d(1.1, 0.9, 1));
  const Eigen::Vector3d x(30, -20, 10);
  const auto y = inverse_at([&](const Eigen::Vector3d& p) { return Eigen::Vector3d(affine * p); }, x);
  ASSERT_TRUE(y);
  EXPECT_LT((*y - affine.inverse() * x).norm(), 2e-3);
}

TEST(PlaceMap, OfASinkingBumpThePlaceThatComesHereIsFound) {
  const PlaceMap sinks = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p - 8 * std::exp(-p.head<2>().squaredNorm() / 400) * Eigen::Vector3d::UnitZ());
  };
  const Eigen::Vector3d x(5, -7, 2);
  const auto y = inverse_at(sinks, x);
  ASSERT_TRUE(y);
  EXPECT_NEAR(y->z(), 2 + 8 * std::exp(-74.0 / 400), 2e-3);
  EXPECT_NEAR(y->x(), 5, 2e-3);
}

TEST(PlaceMap, WhereAMapEndsOrFoldsNothingIsFound) {
  const PlaceMap half = [](const Eigen::Vector3d& p) {
    return p.z() > 0 ? std::optional<Eigen::Vector3d>(p + Eigen::Vector3d(0, 0, 3)) : std::nullopt;
  };
  EXPECT_FALSE(inverse_at(half, {0, 0, -1}));  // not known there
  EXPECT_FALSE(inverse_at(half, {0, 0, 2}));   // comes from where it is not known
  EXPECT_TRUE(inverse_at(half, {0, 0, 5}));
  const PlaceMap flat = [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), p.y(), std::abs(p.z())); };
  EXPECT_FALSE(inverse_at(flat, {0, 0, -1}));
}

}  // namespace brainshift::registration::place_map_test
