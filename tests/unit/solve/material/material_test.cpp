// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/material.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "solve/material/check_material.hpp"
#include "tests/unit/solve/material_cases.hpp"

namespace brainshift::solve::material_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Moduli, AreThoseOfLinearElasticity) {
  const Material brain;
  EXPECT_NEAR(shear_modulus(brain), 3000 / 2.98, 1e-12);
  EXPECT_NEAR(bulk_modulus(brain), 3000 / 0.06, 1e-9);
  const Material ogden{.youngs_modulus = nan, .law = Law::ogden, .ogden = {{900, 2}, {100, -2}}};
  EXPECT_EQ(shear_modulus(ogden), 1000);
  EXPECT_NEAR(bulk_modulus(ogden), 2000 * 1.49 / 0.06, 1e-9);
}

TEST(MuchStiffer, DoesNotDependOnTheUnit) {
  for (const double unit : {1.0, 0.1, 1e-3, 7.0, 1e6}) {
    const Material soft{.youngs_modulus = 3000 * unit}, stiff{.youngs_modulus = 30000 * unit},
        less{.youngs_modulus = 29990 * unit};
    EXPECT_TRUE(much_stiffer(shear_modulus(stiff), shear_modulus(soft))) << unit;
    EXPECT_FALSE(much_stiffer(shear_modulus(less), shear_modulus(soft))) << unit;
  }
}

TEST(Stiffened, MultipliesTheStressOfEveryLaw) {
  const Eigen::Matrix3d f = random_deformation(3);
  for (const Material& material : every_law) {
    const Eigen::Matrix3d before = stress(elastic_law(material), f),
                          after = stress(elastic_law(stiffened(material, 1.7)), f);
    EXPECT_LE((after - 1.7 * before).norm(), 1e-12 * before.norm()) << name_of(material);
  }
}

TEST(Linearised, KeepsTheModuliOfEveryLaw) {
  for (const Material& material : every_law) {
    const Material linear = linearised(material);
    EXPECT_EQ(linear.law, Law::linear_elastic);
    EXPECT_NEAR(shear_modulus(linear), shear_modulus(material), 1e-12 * shear_modulus(material));
    EXPECT_NEAR(bulk_modulus(linear), bulk_modulus(material), 1e-12 * bulk_modulus(material));
    EXPECT_NO_THROW(check_material("for small strains", linear));
  }
}

TEST(LongTerm, KeepsTheBulkModulusAndLosesTheRelaxingShares) {
  for (const Law law : {Law::neo_hookean, Law::ogden, Law::saint_venant_kirchhoff, Law::linear_elastic}) {
    const std::vector<OgdenTerm> terms = {{900, 2}, {-100, 3}};
    const Material material{.law = law,
                            .ogden = law == Law::ogden ? terms : std::vector<OgdenTerm>(),
                            .prony = {{0.450, 0.50}, {0.365, 50}}};
    const Material left = long_term(material);
    EXPECT_TRUE(left.prony.empty());
    EXPECT_NEAR(shear_modulus(left), 0.185 * shear_modulus(material), 1e-10);
    EXPECT_NEAR(bulk_modulus(left), bulk_modulus(material), 1e-9 * bulk_modulus(material));
    EXPECT_EQ(left.density, material.density);
    EXPECT_NO_THROW(check_material("what is left", left));
  }
}

}  // namespace brainshift::solve::material_test
