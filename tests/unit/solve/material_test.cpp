// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <random>

#include "solve/material/neo_hookean.hpp"

namespace brainshift::solve {
namespace {

const NeoHookean law(Material{3000, 0.49, 1000});

double energy(const Eigen::Matrix3d& f) {
  const Deformation d(f);
  return law.isochoric_energy(d) + law.volumetric_energy(d.jacobian);
}

Eigen::Matrix3d stress(const Eigen::Matrix3d& f) {
  const Deformation d(f);
  return law.isochoric_stress(d) + law.pressure(d.jacobian) * d.cofactor;
}

Eigen::Matrix3d random_deformation(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(-0.3, 0.3);
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  for (double& entry : f.reshaped()) {
    entry += within(random);
  }
  return f;
}

/// ∂P/∂F by central differences, (9 × 9), symmetric.
Eigen::Matrix<double, 9, 9> numerical_tangent(const Eigen::Matrix3d& f) {
  constexpr double step = 1e-5;
  Eigen::Matrix<double, 9, 9> tangent;
  for (int i = 0; i < 9; ++i) {
    Eigen::Matrix3d ahead = f, behind = f;
    ahead.reshaped()[i] += step;
    behind.reshaped()[i] -= step;
    tangent.col(i) = ((stress(ahead) - stress(behind)) / (2 * step)).reshaped();
  }
  return tangent;
}

TEST(NeoHookean, StressIsTheDerivativeOfItsEnergy) {
  constexpr double step = 1e-6;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Eigen::Matrix3d f = random_deformation(seed);
    const Eigen::Matrix3d p = stress(f);
    for (int i = 0; i < 9; ++i) {
      Eigen::Matrix3d ahead = f, behind = f;
      ahead.reshaped()[i] += step;
      behind.reshaped()[i] -= step;
      EXPECT_NEAR((energy(ahead) - energy(behind)) / (2 * step), p.reshaped()[i], 1e-5 * p.norm() + 1e-3);
    }
  }
}

TEST(NeoHookean, IsFrameIndifferent) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Eigen::Matrix3d f = random_deformation(seed);
    EXPECT_LE((stress(turn * f) - turn * stress(f)).norm(), 1e-10 * stress(f).norm());
    EXPECT_NEAR(energy(turn * f), energy(f), 1e-10 * energy(f));
  }
}

TEST(NeoHookean, HasNoStressAtRestAndTheLinearModuliThere) {
  EXPECT_LE(stress(Eigen::Matrix3d::Identity()).norm(), 1e-10);
  const auto tangent = numerical_tangent(Eigen::Matrix3d::Identity());
  const double mu = 3000 / (2 * 1.49);
  const double lambda = 3000 * 0.49 / (1.49 * 0.02);
  EXPECT_NEAR(tangent(0, 0), lambda + 2 * mu, 1e-3 * lambda);
  EXPECT_NEAR(tangent(0, 4), lambda, 1e-3 * lambda);
  EXPECT_NEAR(tangent(1, 1), mu, 1e-3 * mu);
  EXPECT_NEAR(law.wave_modulus(), lambda + 2 * mu, 1e-9 * lambda);
}

TEST(NeoHookean, LargestTangentIsTheLargestEigenvalueOfTheTangent) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Eigen::Matrix3d f = random_deformation(seed);
    const Eigen::Vector3d stretch = f.jacobiSvd().singularValues();
    const double expected =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>>(numerical_tangent(f)).eigenvalues().maxCoeff();
    EXPECT_NEAR(largest_tangent(law, stretch, law.pressure(stretch.prod())), expected, 1e-5 * expected);
  }
}

TEST(NeoHookean, LargestTangentHasNoSingularityAtEqualStretches) {
  EXPECT_NEAR(largest_tangent(law, Eigen::Vector3d::Ones(), 0), 3 * law.bulk_modulus, 1e-9 * law.bulk_modulus);
}

}  // namespace
}  // namespace brainshift::solve
