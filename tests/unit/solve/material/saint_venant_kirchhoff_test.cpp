// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/saint_venant_kirchhoff.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace brainshift::solve::saint_venant_kirchhoff_test {

const Material brain{.youngs_modulus = 3000, .poisson_ratio = 0.4, .law = Law::saint_venant_kirchhoff};

Eigen::Matrix3d stretched_along_x(double stretch) {
  return Eigen::Vector3d(stretch, 1, 1).asDiagonal().toDenseMatrix();
}

Eigen::Matrix3d stress(const SaintVenantKirchhoff& law, const Eigen::Matrix3d& f) {
  const Deformation d(f);
  return law.isochoric_stress(d) + law.bulk_modulus * law.dilatation(d) * law.dilatation_slope(d);
}

/// P_11 = (λ + 2µ) λ_1 (λ_1² − 1)/2 where only x is stretched.
TEST(SaintVenantKirchhoff, StretchesOneWayAsTheTextbookSays) {
  const SaintVenantKirchhoff law(brain);
  const double modulus = law.bulk_modulus + 4 * law.shear_modulus / 3;
  for (const double stretch : {0.4, 0.9, 1.0, 1.3}) {
    const Eigen::Matrix3d p = stress(law, stretched_along_x(stretch));
    EXPECT_NEAR(p(0, 0), modulus * stretch * (stretch * stretch - 1) / 2, 1e-11 * modulus);
    EXPECT_NEAR(p(1, 1), (law.bulk_modulus - 2 * law.shear_modulus / 3) * (stretch * stretch - 1) / 2, 1e-11 * modulus);
  }
}

TEST(SaintVenantKirchhoff, GivesWayAtAStretchOf058) {
  const SaintVenantKirchhoff law(brain);
  const double limit = 1 / std::sqrt(3.0);
  const auto push = [&](double stretch) { return -stress(law, stretched_along_x(stretch))(0, 0); };
  EXPECT_GT(push(limit), push(limit + 0.05));
  EXPECT_GT(push(limit), push(limit - 0.05)) << "pressed further it resists less";
}

TEST(SaintVenantKirchhoff, DoesNotSeeARotation) {
  const SaintVenantKirchhoff law(brain);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  EXPECT_NEAR(stress(law, turn).norm(), 0, 1e-12 * law.bulk_modulus);
  const Eigen::Matrix3d f = stretched_along_x(1.3);
  EXPECT_NEAR(law.isochoric_energy(Deformation(turn * f)), law.isochoric_energy(Deformation(f)),
              1e-12 * law.shear_modulus);
}

TEST(SaintVenantKirchhoff, LargestTangentAtRestIsThatOfADilatation) {
  const SaintVenantKirchhoff law(brain);
  EXPECT_NEAR(largest_tangent(law, Eigen::Matrix3d::Identity(), 0), 3 * law.bulk_modulus, 1e-6 * law.bulk_modulus);
}

}  // namespace brainshift::solve::saint_venant_kirchhoff_test
