// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/sizing/sizing_field.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/discretise/bodies.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::discretise::sizing_field_test {

using Eigen::Vector3d;

TEST(SizingField, AsksForNothingWhereNothingIsAsked) {
  const SizingField none;
  EXPECT_TRUE(none.is_uniform());
  EXPECT_EQ(none.factor({1e3, -1e3, 0}), 1);
  EXPECT_EQ(none.smallest(), 1);
  EXPECT_TRUE(sizing_by_spacing(test::box({0, 0, 0}, {9, 9, 9}), nullptr, {})(5).is_uniform());
}

TEST(SizingField, IsExactForWhatIsLinearAndContinuesItsBorderOutside) {
  const Vector3d low(-2, 3, 4), high(6, 8, 13);
  const auto linear = [](const Vector3d& x) { return 0.5 + 0.01 * x.x() - 0.02 * x.y() + 0.03 * x.z(); };
  const SizingField field(low, high, 1.0, linear);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 100; ++i) {
    const Vector3d x = low + Vector3d(share(random), share(random), share(random)).cwiseProduct(high - low);
    EXPECT_NEAR(field.factor(x), linear(x), 1e-12);
  }
  EXPECT_NEAR(field.factor({-50, 5, 5}), linear({-2, 5, 5}), 1e-12);
  EXPECT_NEAR(field.factor({60, 5, 50}), linear({6, 5, 13}), 1e-12);
  EXPECT_NEAR(field.smallest(), linear({-2, 8, 4}), 1e-12);
}

TEST(SizingField, OfACraniotomyIsItsFactorWithinTheRadiusAndGrowsBackByAQuarterOfTheDistance) {
  DiscretiseOptions options;
  options.craniotomy = Refinement{.centres = Eigen::RowVector3d(0, 0, 0), .radius = 20, .factor = 0.4};
  constexpr double spacing = 8;
  const SizingField field = sizing_by_spacing(test::box({-60, -60, -60}, {60, 60, 60}), nullptr, options)(spacing);
  const auto at = [&](double r) { return field.factor(r * Vector3d(2, -1, 2) / 3); };
  for (const double r : {0.0, 10.0, 15.0}) {
    EXPECT_NEAR(at(r), 0.4, 1e-9) << r;
  }
  for (const double r : {27.0, 32.0}) {
    EXPECT_NEAR(at(r), 0.4 + 0.25 * (r - 20) / spacing, 0.02) << r;
  }
  EXPECT_NEAR(at(44), 1, 1e-9);
  EXPECT_NEAR(field.smallest(), 0.4, 1e-12);
}

TEST(SizingField, OfATumourGrowsBackByAQuarterOfTheDistance) {
  const Vector3d centre(30, -20, 10);
  const LabelMap labels = test::ball_labels(centre, 6, 20);
  DiscretiseOptions options;
  options.tumour_factor = 0.5;
  constexpr double spacing = 4;
  const SizingField field = sizing_by_spacing(test::ball(20, centre, 3), &labels, options)(spacing);
  const auto at = [&](double r) { return field.factor(centre + r * Vector3d(1, 2, -2) / 3); };
  EXPECT_NEAR(at(0), 0.5, 1e-9);
  EXPECT_NEAR(at(4), 0.5, 0.02);
  for (const double r : {9.0, 10.0, 12.0}) {
    EXPECT_NEAR(at(r), 0.5 + 0.25 * (r - 6) / spacing, 0.1) << r;
  }
  EXPECT_NEAR(at(18), 1, 1e-9);
  options.tumour_label = 7;
  EXPECT_TRUE(sizing_by_spacing(test::ball(20, centre, 3), &labels, options)(spacing).is_uniform()) << "no such tissue";
}

TEST(SizingField, OfATissueBoundaryIsFinestThere) {
  const Vector3d centre(30, -20, 10);
  const LabelMap labels = test::ball_labels(centre, 9, 20);
  DiscretiseOptions options;
  options.tissue_boundary_factor = 0.5;
  const SizingField field = sizing_by_spacing(test::ball(20, centre, 3), &labels, options)(3);
  const auto at = [&](double r) { return field.factor(centre + r * Vector3d(1, 2, -2) / 3); };
  EXPECT_LT(at(9), 0.6);
  EXPECT_GT(at(3), 0.85);
  EXPECT_GT(at(16), 0.85);
}

TEST(SizingField, CountsNoBoundaryBetweenTissuesThatAreAlike) {
  const Vector3d centre(30, -20, 10);
  const LabelMap labels = test::ball_labels(centre, 9, 20);  // 3 in 1
  DiscretiseOptions options;
  options.tissue_boundary_factor = 0.5;
  options.alike = {{1, 2}, {2, 3}};
  EXPECT_FALSE(sizing_by_spacing(test::ball(20, centre, 3), &labels, options)(3).is_uniform());
  options.alike = {{1, 3}};
  EXPECT_TRUE(sizing_by_spacing(test::ball(20, centre, 3), &labels, options)(3).is_uniform());
}

TEST(SizingField, TakesTheFinestOfWhatIsAsked) {
  const Vector3d centre(30, -20, 10);
  const LabelMap labels = test::ball_labels(centre, 6, 20);
  DiscretiseOptions options;
  options.tumour_factor = 0.7;
  options.craniotomy = Refinement{.centres = centre.transpose(), .radius = 8, .factor = 0.3};
  const SizingField field = sizing_by_spacing(test::ball(20, centre, 3), &labels, options)(3);
  EXPECT_NEAR(field.factor(centre), 0.3, 1e-9);
}

}  // namespace brainshift::discretise::sizing_field_test
