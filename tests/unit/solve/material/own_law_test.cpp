// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/own_law.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/material_cases.hpp"

namespace brainshift::solve::own_law_test {

const Material neo_hookean{.youngs_modulus = 2 * 1.3 * 1000, .poisson_ratio = 0.3};  // µ = 1000 Pa

TEST(OwnLaw, TakesItsModuliFromTheOwnElasticityAndPoissonsRatio) {
  const OwnLaw law(fung(1000, 0.5, 0.3));
  EXPECT_EQ(law.shear_modulus, 1000);
  EXPECT_NEAR(law.bulk_modulus, NeoHookean(neo_hookean).bulk_modulus, 1e-9);
}

/// Fung's law tends to the neo-Hookean one as its exponent tends to 0.
TEST(OwnLaw, OfFungWithASmallExponentIsNeoHookean) {
  const OwnLaw own(fung(1000, 1e-9, 0.3));
  const NeoHookean library(neo_hookean);
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Eigen::Matrix3d f = random_deformation(seed);
    const Deformation d(f);
    const double p = library.bulk_modulus * library.dilatation(d);
    EXPECT_LE((own.isochoric_stress(d) - library.isochoric_stress(d)).norm(), 1e-5);
    EXPECT_NEAR(own.isochoric_energy(d), library.isochoric_energy(d), 1e-5);
    EXPECT_EQ(own.dilatation(d), library.dilatation(d));
    EXPECT_NEAR(largest_tangent(own, f, p), largest_tangent(library, f, p), 1e-4 * library.bulk_modulus);
  }
}

/// W = µ/(2b) (exp(b γ²) − 1) in simple shear: the tangent along it grows by exp(b γ²)(1 + 2bγ²).
TEST(OwnLaw, OfFungStiffensWithShear) {
  const double b = 0.5, shear = 0.8;
  const OwnLaw law(fung(1000, b, 0.3));
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(0, 1) = shear;
  EXPECT_NEAR(law.isochoric_stress(Deformation(f))(0, 1), 1000 * shear * std::exp(b * shear * shear), 1e-9);
  EXPECT_GE(largest_tangent(law, f, 0), 1000 * std::exp(b * shear * shear) * (1 + 2 * b * shear * shear));
}

}  // namespace brainshift::solve::own_law_test
