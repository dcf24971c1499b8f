// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/check_material.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "solve/material/material.hpp"
#include "solve/material/ogden.hpp"
#include "solve/material/own_elasticity.hpp"

namespace brainshift::solve::check_material_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::string complaint(const Material& material) {
  try {
    check_material("the material of label 2", material);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

TEST(CheckMaterial, AcceptsWhatCanBeComputed) {
  EXPECT_EQ(complaint({}), "none");
  EXPECT_EQ(complaint({.poisson_ratio = -0.9}), "none");
  EXPECT_EQ(complaint({.youngs_modulus = -1, .law = Law::ogden, .ogden = {{-100, 2}, {101, -3}}}), "none");
  EXPECT_EQ(complaint({.prony = {{0, 1}, {0.999, 1e-6}}}), "none");
}

TEST(CheckMaterial, WantsEnergyAndStressOfAnOwnLaw) {
  const auto own = [](OwnElasticity law) {
    return Material{.law = Law::own, .own = std::make_shared<const OwnElasticity>(std::move(law))};
  };
  const auto no_energy = [](const Deformation&) { return 0.0; };
  const auto no_stress = [](const Deformation&) { return Eigen::Matrix3d(Eigen::Matrix3d::Zero()); };
  EXPECT_EQ(complaint(own({.shear_modulus = 1, .energy = no_energy, .stress = no_stress})), "none");
  const std::string missing =
      "the material of label 2 follows a law of its own but does not bring its energy and stress";
  EXPECT_EQ(complaint({.law = Law::own}), missing);
  EXPECT_EQ(complaint(own({.shear_modulus = 1, .energy = no_energy, .stress = {}})), missing);
  EXPECT_EQ(complaint(own({.shear_modulus = 1, .energy = {}, .stress = no_stress})), missing);
  EXPECT_EQ(complaint(own({.shear_modulus = 0, .energy = no_energy, .stress = no_stress})),
            "the material of label 2 has a law of its own with mu = 0 Pa; it must be positive");
}

TEST(CheckMaterial, SaysWhichElasticConstantIsWrong) {
  const std::string start = "the material of label 2: ";
  for (const double modulus : {0.0, -1.0, nan, infinity}) {
    EXPECT_TRUE(complaint({.youngs_modulus = modulus}).starts_with(start + "youngs_modulus is '"));
  }
  EXPECT_EQ(complaint({.youngs_modulus = -1}),
            start + "youngs_modulus is '-1', but must be a number > 0 and <= 1e+15 (Pa)");
  for (const double ratio : {-1.0, 0.5, 0.51, nan}) {
    EXPECT_TRUE(complaint({.poisson_ratio = ratio}).starts_with(start + "poisson_ratio is '"));
  }
  EXPECT_EQ(complaint({.poisson_ratio = 0.5}),
            start +
                "poisson_ratio is '0.5', but must be a number > -1 and < 0.5, which is incompressible; for brain "
                "0.49");
  for (const double density : {0.0, -1.0, nan, infinity}) {
    EXPECT_TRUE(complaint({.density = density}).starts_with(start + "density is '"));
  }
}

TEST(CheckMaterial, SaysWhatIsWrongWithOgdenTerms) {
  const auto of = [](std::vector<OgdenTerm> terms) {
    return complaint({.law = Law::ogden, .ogden = std::move(terms)});
  };
  EXPECT_EQ(of({}),
            "the material of label 2 follows Ogden's law but has no terms; give at least one pair of mu and alpha");
  EXPECT_EQ(of({{842, 0}}), "the material of label 2 has an Ogden term with alpha = 0; it must be finite and not 0");
  EXPECT_NE(of({{842, nan}}).find("alpha = nan"), std::string::npos);
  EXPECT_NE(of({{infinity, 2}}).find("mu = inf"), std::string::npos);
  EXPECT_EQ(of({{100, 2}, {-100, 3}}),
            "the material of label 2 is unstable at rest: the mu of its Ogden terms add up to 0 Pa; the sum must be "
            "positive");
  EXPECT_EQ(of(std::vector<OgdenTerm>(7, {100, 2})),
            "the material of label 2 has 7 Ogden terms; at most 6 are supported");
  EXPECT_EQ(complaint({.ogden = {{842, -4.7}}}),
            "the material of label 2 has the Ogden terms 842,-4.7 but follows the law neo_hookean; set the law to "
            "ogden, or ogden to nothing");
}

TEST(CheckMaterial, SaysWhatIsWrongWithPronyTerms) {
  EXPECT_EQ(complaint({.prony = {{-0.1, 1}}}),
            "the material of label 2 has a Prony term with the share -0.1; it must not be negative");
  EXPECT_NE(complaint({.prony = {{nan, 1}}}).find("share nan"), std::string::npos);
  for (const double time : {0.0, -1.0, nan, infinity}) {
    EXPECT_TRUE(complaint({.prony = {{0.1, time}}}).ends_with(" s; it must be positive"));
  }
  EXPECT_EQ(complaint({.prony = {{0.5, 1}, {0.5, 2}}}),
            "the material of label 2 has Prony shares that add up to 1; the sum must be below 1, or nothing would hold "
            "the tissue in the end");
}

}  // namespace brainshift::solve::check_material_test
