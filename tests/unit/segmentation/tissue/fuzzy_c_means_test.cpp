// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/tissue/fuzzy_c_means.hpp"

#include <array>
#include <limits>
#include <random>

#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::fuzzy_c_means_test {

using namespace segmentation;

using segmentation::fuzzy_c_means;
using segmentation::fuzzy_memberships;

std::vector<float> mixture() {
  std::mt19937 generator(1);
  std::vector<float> values;
  for (const double mean : {30.0, 80.0, 120.0}) {
    std::normal_distribution<float> normal(static_cast<float>(mean), 4.0F);
    for (int i = 0; i < 20000; ++i) {
      values.push_back(normal(generator));
    }
  }
  return values;
}

TEST(FuzzyCMeans, FindsTheMeansOfAKnownMixtureDarkestFirst) {
  const auto centres = fuzzy_c_means(mixture(), 3);
  ASSERT_EQ(centres.size(), 3U);
  EXPECT_NEAR(centres[0], 30.0, 1.0);
  EXPECT_NEAR(centres[1], 80.0, 1.0);
  EXPECT_NEAR(centres[2], 120.0, 1.0);
}

// The definition, on every value instead of a histogram: at a fixed point each centre is the mean of the values
// weighted with the square of their memberships.
TEST(FuzzyCMeans, TheCentresAreAFixedPointOnTheValuesThemselves) {
  const auto values = mixture();
  const auto centres = fuzzy_c_means(values, 3);
  std::array<double, 3> weights{};
  std::array<double, 3> sums{};
  std::array<double, 3> memberships{};
  for (const float value : values) {
    fuzzy_memberships(centres, value, memberships);
    for (std::size_t c = 0; c < 3; ++c) {
      weights[c] += memberships[c] * memberships[c];
      sums[c] += memberships[c] * memberships[c] * static_cast<double>(value);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(sums[c] / weights[c], centres[c], 0.1);
  }
}

TEST(FuzzyCMeans, MembershipsFollowTheInverseSquaredDistancesAndSumToOne) {
  const std::array<double, 2> centres = {0.0, 3.0};
  std::array<double, 2> memberships{};
  fuzzy_memberships(centres, 1.0, memberships);
  EXPECT_NEAR(memberships[0], 0.8, 1e-12);
  EXPECT_NEAR(memberships[1], 0.2, 1e-12);
  fuzzy_memberships(centres, 3.0, memberships);
  EXPECT_NEAR(memberships[1], 1.0, 1e-12);
}

TEST(FuzzyCMeans, TheUnitOfTheIntensitiesDoesNotMatter) {
  auto values = mixture();
  const auto centres = fuzzy_c_means(values, 3);
  for (float& value : values) {
    value *= 1e-8F;
  }
  const auto tiny = fuzzy_c_means(values, 3);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(tiny[c] * 1e8, centres[c], 1e-2);
  }
}

TEST(FuzzyCMeans, ValuesThatCannotBeToldApartAreRefused) {
  EXPECT_TRUE(
      throws_saying<std::invalid_argument>([] { fuzzy_c_means(std::vector<float>(100, 5.0F), 3); }, {"too alike"}));
  EXPECT_TRUE(throws_saying<std::invalid_argument>([] { fuzzy_c_means({}, 3); }, {"finite"}));
  EXPECT_TRUE(throws_saying<std::invalid_argument>([] { fuzzy_c_means(mixture(), 1); }, {"at least 2"}));
  const std::vector<float> broken = {1.0F, 2.0F, std::numeric_limits<float>::quiet_NaN()};
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { fuzzy_c_means(broken, 2); }, {"finite"}));
}

}  // namespace brainshift::test::fuzzy_c_means_test
