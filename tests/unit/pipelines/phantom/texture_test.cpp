// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/phantom/texture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace brainshift::pipelines::texture_test {

using Eigen::Vector3d;

std::vector<Vector3d> some_places() {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> within(-200, 200);
  std::vector<Vector3d> places(3000);
  for (Vector3d& place : places) {
    place = {within(random), within(random), within(random)};
  }
  return places;
}

TEST(SmoothNoise, FillsItsRangeEvenlyAboutZero) {
  double sum = 0, low = 0, high = 0;
  for (const Vector3d& place : some_places()) {
    const double value = smooth_noise(place, 10, 1);
    EXPECT_LE(std::abs(value), 1);
    low = std::min(low, value);
    high = std::max(high, value);
    sum += value;
  }
  EXPECT_LT(low, -0.6);
  EXPECT_GT(high, 0.6);
  EXPECT_NEAR(sum / 3000, 0, 0.03);
}

TEST(SmoothNoise, VariesOverTheWavelength) {
  double over_a_step = 0, over_a_wave = 0;
  for (const Vector3d& place : some_places()) {
    const double here = smooth_noise(place, 10, 1);
    over_a_step = std::max(over_a_step, std::abs(smooth_noise(place + Vector3d(0.01, 0.01, 0.01), 10, 1) - here));
    over_a_wave = std::max(over_a_wave, std::abs(smooth_noise(place + Vector3d(10, 10, 10), 10, 1) - here));
  }
  EXPECT_LT(over_a_step, 0.02);
  EXPECT_GT(over_a_wave, 0.8);
  EXPECT_EQ(smooth_noise({3, 5, -7}, 10, 1), smooth_noise({0.3, 0.5, -0.7}, 1, 1));
}

TEST(SmoothNoise, IsSmoothThroughTheCornersOfItsLattice) {
  constexpr double h = 1e-3;
  for (const double corner : {-20.0, 0.0, 30.0}) {
    const auto along_x = [&](double x) { return smooth_noise({corner + x, 4, 7}, 10, 3); };
    EXPECT_NEAR((along_x(h) - along_x(-h)) / (2 * h), 0, 1e-5) << "the slope is none there";
    EXPECT_NEAR((along_x(h) - 2 * along_x(0) + along_x(-h)) / (h * h), 0, 1e-3) << "nor is there a bend";
  }
}

TEST(SmoothNoise, IsAnotherForAnotherSeed) {
  double product = 0, square = 0;
  for (const Vector3d& place : some_places()) {
    EXPECT_EQ(smooth_noise(place, 10, 5), smooth_noise(place, 10, 5));
    product += smooth_noise(place, 10, 5) * smooth_noise(place, 10, 6);
    square += std::pow(smooth_noise(place, 10, 5), 2);
  }
  EXPECT_LT(std::abs(product), 0.08 * square) << "they have nothing in common";
}

}  // namespace brainshift::pipelines::texture_test
