// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/elastic_law.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "tests/unit/solve/material_cases.hpp"

namespace brainshift::solve::elastic_law_test {

using Tangent = Eigen::Matrix<double, 9, 9>;

const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();

template <class Function>
Tangent numerical_derivative(const Function& function, const Eigen::Matrix3d& f) {
  constexpr double step = 1e-5;
  Tangent derivative;
  for (int i = 0; i < 9; ++i) {
    Eigen::Matrix3d ahead = f, behind = f;
    ahead.reshaped()[i] += step;
    behind.reshaped()[i] -= step;
    derivative.col(i) = ((function(ahead) - function(behind)) / (2 * step)).reshaped();
  }
  return derivative;
}

Tangent numerical_tangent(const ElasticLaw& law, const Eigen::Matrix3d& f) {
  return numerical_derivative([&](const Eigen::Matrix3d& at) { return stress(law, at); }, f);
}

/// ∂²W_iso/∂F∂F + p ∂²θ/∂F∂F + K ∂θ/∂F ∂θ/∂F with p as given.
Tangent numerical_tangent(const ElasticLaw& law, const Eigen::Matrix3d& f, double p) {
  const double bulk = std::visit([](const auto& l) { return l.bulk_modulus; }, law);
  const Eigen::Matrix<double, 9, 1> slope = dilatation_slope(law, f).reshaped();
  const auto at_pressure = [&](const Eigen::Matrix3d& at) -> Eigen::Matrix3d {
    return isochoric_stress(law, at) + p * dilatation_slope(law, at);
  };
  return numerical_derivative(at_pressure, f) + bulk * slope * slope.transpose();
}

double largest_eigenvalue(const Tangent& tangent) {
  return Eigen::SelfAdjointEigenSolver<Tangent>(tangent).eigenvalues().maxCoeff();
}

class EveryLaw : public testing::TestWithParam<Material> {
 protected:
  const ElasticLaw law = elastic_law(GetParam());
  const double shear = shear_modulus(GetParam());
  const double bulk = bulk_modulus(GetParam());

  double largest(const Eigen::Matrix3d& f, double p) const {
    return std::visit([&](const auto& l) { return largest_tangent(l, f, p); }, law);
  }
  void expect_largest_tangent(const Eigen::Matrix3d& f, double p) const {
    const double expected = largest_eigenvalue(numerical_tangent(law, f, p));
    EXPECT_NEAR(largest(f, p), expected, 1e-6 * std::abs(expected)) << f << "\np = " << p;
  }
};

INSTANTIATE_TEST_SUITE_P(Material, EveryLaw, testing::ValuesIn(every_law),
                         [](const auto& tested) { return name_of(tested.param); });

class FiniteStrainLaw : public EveryLaw {};

INSTANTIATE_TEST_SUITE_P(Material, FiniteStrainLaw, testing::ValuesIn(finite_strain_laws),
                         [](const auto& tested) { return name_of(tested.param); });

TEST_P(EveryLaw, StressIsTheDerivativeOfItsEnergy) {
  constexpr double step = 1e-5;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Eigen::Matrix3d f = random_deformation(seed);
    const Eigen::Matrix3d p = stress(law, f);
    for (int i = 0; i < 9; ++i) {
      Eigen::Matrix3d ahead = f, behind = f;
      ahead.reshaped()[i] += step;
      behind.reshaped()[i] -= step;
      EXPECT_NEAR((energy(law, ahead) - energy(law, behind)) / (2 * step), p.reshaped()[i], 1e-7 * p.norm());
    }
  }
}

TEST_P(EveryLaw, DilatationSlopeIsTheDerivativeOfTheDilatation) {
  constexpr double step = 1e-5;
  const Eigen::Matrix3d f = random_deformation(3);
  for (int i = 0; i < 9; ++i) {
    Eigen::Matrix3d ahead = f, behind = f;
    ahead.reshaped()[i] += step;
    behind.reshaped()[i] -= step;
    EXPECT_NEAR((dilatation(law, ahead) - dilatation(law, behind)) / (2 * step), dilatation_slope(law, f).reshaped()[i],
                1e-9);
  }
}

TEST_P(FiniteStrainLaw, ARotationAfterwardsTurnsTheStress) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Eigen::Matrix3d f = random_deformation(seed);
    EXPECT_LE((stress(law, turn * f) - turn * stress(law, f)).norm(), 1e-12 * bulk + 1e-12 * stress(law, f).norm());
    EXPECT_NEAR(energy(law, turn * f), energy(law, f), 1e-12 * bulk);
  }
}

TEST_P(EveryLaw, ARotationBeforehandDoesNotMatterToAnIsotropicBody) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Eigen::Matrix3d f = random_deformation(seed);
    if (GetParam().law == Law::linear_elastic) {  // only if body and strain turn together
      EXPECT_LE((stress(law, turn * f * turn.transpose()) - turn * stress(law, f) * turn.transpose()).norm(),
                1e-12 * bulk);
    } else {
      EXPECT_LE((stress(law, f * turn) - stress(law, f) * turn).norm(), 1e-12 * bulk + 1e-12 * stress(law, f).norm());
    }
  }
}

TEST_P(EveryLaw, HasNoStressAtRestAndTheLinearModuliThere) {
  const Eigen::Matrix3d rest = Eigen::Matrix3d::Identity();
  EXPECT_EQ(stress(law, rest).norm(), 0);
  EXPECT_EQ(energy(law, rest), 0);
  const Tangent tangent = numerical_tangent(law, rest);
  const double lame = bulk - 2 * shear / 3;
  const double tolerance = 1e-7 * (bulk + shear);
  EXPECT_NEAR(tangent(0, 0), lame + 2 * shear, tolerance);
  EXPECT_NEAR(tangent(0, 4), lame, tolerance);
  EXPECT_NEAR(tangent(1, 1), shear, tolerance);
  EXPECT_NEAR(tangent(1, 3), shear, tolerance);
  EXPECT_NEAR(std::visit([](const auto& l) { return l.bulk_modulus + 4 * l.shear_modulus / 3; }, law), lame + 2 * shear,
              tolerance);
}

TEST_P(EveryLaw, SmallStrainsKeepTheirDigits) {
  Eigen::Matrix3d direction;
  direction << 0.3, -0.5, 0.1, 0.7, 0.2, -0.4, 0.6, 0.8, -0.9;
  const double size = 1.0 / (1 << 20);  // a power of two: F − 1 is exact
  const Eigen::Matrix3d f = Eigen::Matrix3d::Identity() + size * direction;
  const Eigen::Matrix3d strain = size / 2 * (direction + direction.transpose());
  const Eigen::Matrix3d expected =
      2 * shear * strain + (bulk - 2 * shear / 3) * strain.trace() * Eigen::Matrix3d::Identity();
  EXPECT_LE((stress(law, f) - expected).norm(), 20 * size * expected.norm());  // what is left is of second order
  if (GetParam().law != Law::neo_hookean && GetParam().law != Law::own) {      // these take 3 from a number close to 3
    EXPECT_NEAR(energy(law, f), expected.cwiseProduct(strain).sum() / 2, 20 * size * energy(law, f));
  }
}

TEST_P(EveryLaw, TangentIsSymmetric) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Tangent tangent = numerical_tangent(law, random_deformation(seed));
    EXPECT_LE((tangent - tangent.transpose()).norm(), 1e-7 * tangent.norm());
  }
}

TEST_P(EveryLaw, LargestTangentIsTheLargestEigenvalueOfTheTangent) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Eigen::Matrix3d f = random_deformation(seed);
    const double p = pressure(law, f);
    EXPECT_NEAR(largest(f, p), largest_eigenvalue(numerical_tangent(law, f)), 1e-6 * largest(f, p));
    expect_largest_tangent(f, p);
    expect_largest_tangent(f, 0.2 * bulk);  // a patch's pressure is not the point's
    expect_largest_tangent(f, -0.2 * bulk);
  }
}

TEST_P(EveryLaw, LargestTangentHoldsAtEqualStretches) {
  for (const double nearly : {0.0, 1e-12, 1e-7, 1e-5, 1e-4}) {
    for (const Eigen::Vector3d& stretch : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0.8, 0.8, 0.8),
                                           Eigen::Vector3d(1.3, 0.8, 0.8), Eigen::Vector3d(1.2, 1.2, 0.7)}) {
      const Eigen::Vector3d about = stretch.cwiseProduct(Eigen::Vector3d(1, 1 + nearly, 1 - 2 * nearly));
      const Eigen::Matrix3d f = turn * about.asDiagonal() * turn;
      for (const double p : {0.0, 0.3 * bulk, -0.3 * bulk}) {
        expect_largest_tangent(f, p);
      }
    }
  }
}

TEST_P(EveryLaw, LargestTangentHoldsUnderStrongCompression) {
  for (const Eigen::Vector3d& stretch :
       {Eigen::Vector3d(0.2, 2.2, 2.3), Eigen::Vector3d(0.2, 0.9, 1.1), Eigen::Vector3d(0.3, 0.3, 0.3)}) {
    const Eigen::Matrix3d f = turn * stretch.asDiagonal() * turn;
    expect_largest_tangent(f, pressure(law, f));
  }
}

}  // namespace brainshift::solve::elastic_law_test
