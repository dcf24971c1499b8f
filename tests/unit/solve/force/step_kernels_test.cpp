// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/force/step_kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "solve/force/batch_stress.hpp"
#include "solve/material/neo_hookean.hpp"

namespace brainshift::solve::step_kernels_test {

constexpr std::int32_t points = 13;  // not a whole number of groups
constexpr std::size_t nodes = 40;

/// Rows of different lengths, padded as point_blocks() does, in both precisions.
struct Rows {
  std::vector<std::int64_t> begin{0};
  std::vector<std::uint16_t> slot;
  std::vector<double> in_double;
  std::vector<float> in_single;
  std::mt19937 random{7};

  Rows() {
    for (std::int32_t p = 0; p < points; ++p) {
      const std::size_t size = 5 + random() % 30, padded = (size + quad - 1) / quad * quad;
      for (std::size_t a = 0; a < padded; ++a) {
        slot.push_back(static_cast<std::uint16_t>((a < size ? a : 0) + static_cast<std::size_t>(p) % 5));
        for (int axis = 0; axis < 3; ++axis) {
          in_single.push_back(a < size ? static_cast<float>(number() / 30) : 0);
          in_double.push_back(static_cast<double>(in_single.back()));
        }
      }
      begin.push_back(static_cast<std::int64_t>(slot.size()));
    }
  }

  double number() { return std::uniform_real_distribution<double>(-1, 1)(random); }

  template <class Scalar>
  PairRows<Scalar> rows() const {
    if constexpr (std::is_same_v<Scalar, float>) {
      return {begin.data(), slot.data(), in_single.data()};
    } else {
      return {begin.data(), slot.data(), in_double.data()};
    }
  }
};

template <class Scalar>
std::vector<Scalar> random_values(Rows& rows, std::size_t count) {
  std::vector<Scalar> values(count);
  for (Scalar& v : values) {
    v = static_cast<Scalar>(rows.number());
  }
  return values;
}

template <class Scalar>
class StepKernelsOf : public testing::Test {};
using Scalars = testing::Types<double, float>;
TYPED_TEST_SUITE(StepKernelsOf, Scalars);

TYPED_TEST(StepKernelsOf, GradientsAreTheSumsOfTheirPairs) {
  Rows rows;
  const auto u = random_values<TypeParam>(rows, 4 * nodes);
  const double rounding = std::is_same_v<TypeParam, float> ? 1e-6 : 1e-14;
  for (const StepKernels& kernels : step_kernels()) {
    std::vector<TensorLanes> found(2);
    kernels.of<TypeParam>().gradients(rows.rows<TypeParam>(), 0, points, u.data(), found.data());
    for (std::size_t p = 0; p < 2 * lanes; ++p) {
      Eigen::Matrix3d expected = Eigen::Matrix3d::Identity();
      for (std::int64_t k = rows.begin[p]; p < points && k < rows.begin[p + 1]; ++k) {
        const auto pair = static_cast<std::size_t>(k);
        for (Eigen::Index i = 0; i < 9; ++i) {
          expected(i % 3, i / 3) += static_cast<double>(u[4 * rows.slot[pair] + static_cast<std::size_t>(i % 3)]) *
                                    rows.in_double[3 * pair + static_cast<std::size_t>(i / 3)];
        }
      }
      EXPECT_LE((tensor(found, p) - expected).cwiseAbs().maxCoeff(), rounding) << kernels.name << ", point " << p;
    }
  }
}

/// f · u = S : (F − 1) for all S and u.
TYPED_TEST(StepKernelsOf, SpreadIsTheTransposeOfGradients) {
  Rows rows;
  const auto u = random_values<TypeParam>(rows, 4 * nodes);
  std::vector<TensorLanes> stress(2), gradient(2);
  for (TensorLanes& group : stress) {
    for (auto& entry : group.entry) {
      for (double& s : entry) {
        s = rows.number();
      }
    }
  }
  const double rounding = std::is_same_v<TypeParam, float> ? 1e-5 : 1e-13;
  for (const StepKernels& kernels : step_kernels()) {
    std::vector<TypeParam> force(4 * nodes, 0);
    kernels.of<TypeParam>().gradients(rows.rows<TypeParam>(), 0, points, u.data(), gradient.data());
    kernels.of<TypeParam>().spread(rows.rows<TypeParam>(), 0, points, stress.data(), force.data());
    double at_points = 0, at_nodes = 0;
    for (std::size_t p = 0; p < points; ++p) {
      at_points += tensor(stress, p).cwiseProduct(tensor(gradient, p) - Eigen::Matrix3d::Identity()).sum();
    }
    for (std::size_t i = 0; i < force.size(); ++i) {
      at_nodes += i % 4 < 3 ? static_cast<double>(force[i]) * static_cast<double>(u[i]) : 0;
    }
    EXPECT_NEAR(at_points, at_nodes, rounding) << kernels.name;
  }
}

/// x^(−1/3) is found from the bits of J: from those that are nearly all zeros, too.
TEST(StepKernels, NeoHookeanIsTheLawAtRoundJacobians) {
  const NeoHookean law(Material{});
  const double round[lanes] = {1, 2, 0.5, 1.5, 0x1p30, 0x1p-30, 1 + 0x1p-20, 1 + 0x1p-52};
  std::vector<TensorLanes> gradient(1), stress(1);
  for (std::size_t i = 0; i < lanes; ++i) {
    const Eigen::Matrix3d stretched = Eigen::Vector3d(round[i], 1, 1).asDiagonal();
    set(gradient, i, stretched);
  }
  const std::vector<double> pressure(lanes, 100), volume(lanes, 2);
  for (const StepKernels& kernels : step_kernels()) {
    kernels.neo_hookean(gradient.data(), 1, law.shear_modulus, pressure.data(), volume.data(), stress.data());
    for (std::size_t i = 0; i < lanes; ++i) {
      const Deformation d(tensor(gradient, i));
      const Eigen::Matrix3d expected = volume[i] * (law.isochoric_stress(d) + pressure[i] * d.cofactor);
      EXPECT_LE((tensor(stress, i) - expected).norm(), 1e-12 * expected.norm()) << kernels.name << ", J " << round[i];
    }
  }
}

/// From far pressed to far stretched, and inside out.
TEST(StepKernels, NeoHookeanIsTheLawAtEachPoint) {
  Rows rows;
  const NeoHookean law(Material{});
  std::vector<TensorLanes> gradient(12), stress(12);
  std::vector<double> pressure = random_values<double>(rows, 12 * lanes), volume(pressure), jacobian(12 * lanes);
  for (std::size_t i = 0; i < 12 * lanes; ++i) {
    const double scale = std::exp(3 * rows.number());
    for (std::size_t k = 0; k < 9; ++k) {
      gradient[i / lanes].entry[k][i % lanes] = scale * ((k % 4 == 0 ? 1.0 : 0.0) + 0.4 * rows.number());
    }
  }
  gradient[0].entry[0][0] *= -1;
  for (const StepKernels& kernels : step_kernels()) {
    kernels.jacobian(gradient.data(), gradient.size(), jacobian.data());
    kernels.neo_hookean(gradient.data(), gradient.size(), law.shear_modulus, pressure.data(), volume.data(),
                        stress.data());
    for (std::size_t i = 0; i < 12 * lanes; ++i) {
      const Deformation d(tensor(gradient, i));
      EXPECT_NEAR(jacobian[i], d.jacobian, 1e-13 * d.gradient.squaredNorm() * d.gradient.norm()) << kernels.name;
      if (d.jacobian > 0) {
        const Eigen::Matrix3d expected = volume[i] * (law.isochoric_stress(d) + pressure[i] * d.cofactor);
        EXPECT_LE((tensor(stress, i) - expected).norm(), 1e-12 * expected.norm()) << kernels.name << ", point " << i;
      } else {
        EXPECT_TRUE(std::isnan(tensor(stress, i)(0, 0))) << kernels.name << ", point " << i;
      }
    }
  }
}

}  // namespace brainshift::solve::step_kernels_test
