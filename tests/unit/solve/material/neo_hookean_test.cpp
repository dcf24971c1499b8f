// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/neo_hookean.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace brainshift::solve::neo_hookean_test {

const Material brain{.youngs_modulus = 3000, .poisson_ratio = 0.49};

TEST(NeoHookean, ShearsInProportionAtAnyAngle) {
  const NeoHookean law(brain);
  const double mu = 3000 / (2 * 1.49);
  for (const double shear : {0.01, 0.5, 3.0}) {
    Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
    f(0, 1) = shear;
    const Deformation d(f);
    EXPECT_NEAR(law.isochoric_stress(d)(0, 1), mu * shear, 1e-12 * mu) << "P_12 = µγ: the term along F⁻ᵀ has none";
    EXPECT_NEAR(law.isochoric_energy(d), mu * shear * shear / 2, 1e-11 * mu);
    EXPECT_NEAR(law.dilatation(d), 0, 1e-15);
  }
}

TEST(NeoHookean, AnswersAPureDilatationByPressureAlone) {
  const NeoHookean law(brain);
  const Deformation swollen(1.2 * Eigen::Matrix3d::Identity());
  EXPECT_NEAR(law.isochoric_energy(swollen), 0, 1e-11 * law.shear_modulus);
  EXPECT_NEAR(law.isochoric_stress(swollen).norm(), 0, 1e-12 * law.shear_modulus);
  EXPECT_NEAR(law.dilatation(swollen), std::pow(1.2, 3) - 1, 1e-14);
}

/// Incompressible uniaxial tension: Cauchy stress µ (λ² − 1/λ), whatever the pressure.
TEST(NeoHookean, StretchesAsTheTextbookSays) {
  const NeoHookean law(brain);
  for (const double stretch : {0.6, 1.5, 2.0}) {
    const double lateral = 1 / std::sqrt(stretch);
    const Deformation d(Eigen::Vector3d(stretch, lateral, lateral).asDiagonal().toDenseMatrix());
    const Eigen::Matrix3d cauchy = law.isochoric_stress(d) * d.gradient.transpose();
    EXPECT_NEAR(cauchy(0, 0) - cauchy(1, 1), law.shear_modulus * (stretch * stretch - 1 / stretch),
                1e-11 * law.shear_modulus);
  }
}

/// At rest the tangent by F is that of linear elasticity: the largest eigenvalue is 3K, of a dilatation, or 2µ.
TEST(NeoHookean, LargestTangentAtRestIsThatOfTheStiffestStrain) {
  const Eigen::Matrix3d rest = Eigen::Matrix3d::Identity();
  const NeoHookean hard_to_press(brain), cork({.youngs_modulus = 1000, .poisson_ratio = -0.5});
  EXPECT_NEAR(largest_tangent(hard_to_press, rest, 0), 3 * hard_to_press.bulk_modulus,
              1e-6 * hard_to_press.bulk_modulus);
  EXPECT_NEAR(largest_tangent(cork, rest, 0), 2 * cork.shear_modulus, 1e-6 * cork.shear_modulus);
}

}  // namespace brainshift::solve::neo_hookean_test
