// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/uncertainty/draw.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::draw_test {

Model two_tissues() {
  Model model = box_model(test::box_cells(2, model_side), 3);
  model.materials[2] = {.youngs_modulus = 10, .poisson_ratio = 0.1};
  return model;
}

TEST(DrawnConstants, AreTheSameForTheSameSeedAndSampleAlone) {
  const Model model = two_tissues();
  const UncertaintyOptions options;
  const auto stiffness = [&](int seed, int sample) {
    UncertaintyOptions other = options;
    other.seed = seed;
    return drawn_constants(model, other, sample).materials.at(1).youngs_modulus;
  };
  EXPECT_EQ(stiffness(1, 5), stiffness(1, 5));
  EXPECT_NE(stiffness(1, 5), stiffness(1, 6));
  EXPECT_NE(stiffness(1, 5), stiffness(2, 5));
}

TEST(DrawnConstants, HaveTheSpreadThatIsAskedFor) {
  const Model model = two_tissues();
  const UncertaintyOptions options;
  constexpr int draws = 2000;
  double sum = 0, squares = 0, together = 0, ratios = 0, ratios_squared = 0, least = 1, most = 0;
  for (int sample = 1; sample <= draws; ++sample) {
    const Constants drawn = drawn_constants(model, options, sample);
    const double one = std::log(drawn.materials.at(1).youngs_modulus / 3000);
    const double two = std::log(drawn.materials.at(2).youngs_modulus / 10);
    sum += one / draws;
    squares += one * one / draws;
    together += one * two / draws;
    EXPECT_GE(drawn.materials.at(1).poisson_ratio, 0.45);
    EXPECT_LE(drawn.materials.at(1).poisson_ratio, most_poisson);
    const double ratio = drawn.materials.at(2).poisson_ratio;
    ratios += ratio / draws;
    ratios_squared += (ratio - 0.1) * (ratio - 0.1) / draws;
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  EXPECT_NEAR(ratios, 0.1, 0.002);
  EXPECT_NEAR(std::sqrt(ratios_squared), 0.04 / std::sqrt(3.0), 0.002) << "uniform";
  EXPECT_TRUE(least >= 0.06 && least < 0.065 && most > 0.135 && most <= 0.14) << least << " to " << most;
  EXPECT_NEAR(sum, 0, 0.02);
  EXPECT_NEAR(std::sqrt(squares), 0.25, 0.01);
  EXPECT_NEAR(together, 0, 0.005) << "tissues are drawn each for itself";
}

TEST(DrawnConstants, TurnGravityAndTheFluidsSurfaceAboutTheMiddle) {
  Model model = two_tissues();
  model.fluid = DrainedFluid{.gravity = {0, 9.8, 0}, .gravity_of_image = {0, 9.8, 0}, .level = 20};
  UncertaintyOptions options;
  const Eigen::Vector3d middle = model.cloud.positions.colwise().mean();
  constexpr int draws = 1000;
  double tilts = 0, levels = 0;
  for (int sample = 1; sample <= draws; ++sample) {
    const DrainedFluid fluid = *drawn_constants(model, options, sample).fluid;
    EXPECT_NEAR(fluid.gravity.norm(), 9.8, 1e-9);
    EXPECT_LT((fluid.gravity - fluid.gravity_of_image).norm(), 1e-12) << "both directions turn alike";
    const Eigen::Vector3d direction = fluid.gravity / 9.8;
    tilts += std::pow(std::acos(std::min(1.0, direction.y())) * 180 / std::numbers::pi, 2) / draws;
    levels += std::pow((fluid.level - middle.dot(direction)) - (20 - middle.y()), 2) / draws;
  }
  EXPECT_NEAR(std::sqrt(tilts), 5 * std::sqrt(2), 0.4);
  EXPECT_NEAR(std::sqrt(levels), 5, 0.4);
}

TEST(DrawnConstants, AreTheModelsOwnWhereAllIsKnown) {
  Model model = two_tissues();
  UncertaintyOptions known{.stiffness = 0, .poisson = 0};
  EXPECT_FALSE(varies(model, known)) << "no gravity acts";
  const Constants drawn = drawn_constants(model, known, 1);
  EXPECT_EQ(drawn.materials.at(1).youngs_modulus, 3000);
  EXPECT_EQ(drawn.materials.at(2).poisson_ratio, 0.1);
  model.gravity = {0, 0, -9.8};
  EXPECT_TRUE(varies(model, known));
  EXPECT_NE(with_constants(model, drawn_constants(model, known, 1)).gravity, model.gravity);
}

TEST(DrawnConstants, ScaleTheTermsOfOgdensLaw) {
  Model model = two_tissues();
  model.materials[1] = Material{.law = Law::ogden, .ogden = {{842, -4.7}}};
  const Material drawn = drawn_constants(model, {}, 1).materials.at(1);
  EXPECT_NE(drawn.ogden[0].shear_modulus, 842);
  EXPECT_EQ(drawn.ogden[0].exponent, -4.7);
  EXPECT_NEAR(shear_modulus(drawn) / 842, drawn.youngs_modulus / 3000, 1e-12);
}

}  // namespace brainshift::solve::draw_test
