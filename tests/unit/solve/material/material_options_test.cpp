// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/material_options.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solve/material/named_materials.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::solve::material_options_test {

using test::refusal;

std::string fault(const Material& material) {
  return refusal([&] { check_table(material_options(), material); });
}

// A new member of the struct does not compile here: it goes into the table.
TEST(MaterialOptions, AreAllInTheTable) {
  [[maybe_unused]] const auto& [youngs_modulus, poisson_ratio, density, swelling, room, law, ogden, prony, own] =
      Material{};
  EXPECT_EQ(material_options().size() + 1, 9U) << "beside the law that a program brings along";
}

TEST(MaterialOptions, SurviveBeingWrittenAndRead) {
  for (const std::string& name : material_names()) {
    const Material material = *named_material(name);
    EXPECT_EQ(fault(material), "");
    Material copy;
    for (const auto& option : material_options()) {
      ASSERT_TRUE(set_option(option, copy, option.get(material))) << option.name;
    }
    EXPECT_EQ(shear_modulus(copy), shear_modulus(material)) << name;
    EXPECT_EQ(bulk_modulus(copy), bulk_modulus(material)) << name;
    EXPECT_EQ(shear_modulus(long_term(copy)), shear_modulus(long_term(material))) << name;
    EXPECT_EQ(copy.density, material.density) << name;
    EXPECT_EQ(copy.swelling, material.swelling) << name;
    EXPECT_EQ(copy.room, material.room) << name;
  }
}

TEST(MaterialOptions, OutOfRangeAreRefusedWithTheirUnit) {
  EXPECT_EQ(fault({.youngs_modulus = 0}), "youngs_modulus is '0', but must be a number > 0 and <= 1e+15 (Pa)");
  EXPECT_EQ(fault({.density = -1}), "density is '-1', but must be a number > 0 and <= 100000000 (kg/m3)");
  EXPECT_EQ(fault({.law = Law::own}).substr(0, 6), "law is") << "a scene has no such law";
  EXPECT_EQ(fault({.prony = {{0.5, std::nan("")}}}),
            "prony is '0.5,nan', but must be pairs share,time separated by semicolons, or nothing (1 and s)");
}

TEST(MaterialOptions, PoissonsRatioIsBetweenMinusOneAndAHalf) {
  EXPECT_EQ(fault({.poisson_ratio = -0.99}), "");
  EXPECT_EQ(fault({.poisson_ratio = 0.4999}), "");
  for (const double bad : {-1.0, 0.5, std::nan("")}) {
    EXPECT_TRUE(fault({.poisson_ratio = bad}).ends_with("which is incompressible; for brain 0.49")) << bad;
  }
}

}  // namespace brainshift::solve::material_options_test
