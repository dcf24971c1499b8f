// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "solve/material/neo_hookean.hpp"

namespace brainshift::solve::each_kernels_test {

/// H of some size, other for each member and point.
template <class Scalar>
std::vector<TensorOfEach<Scalar>> some_gradients(std::size_t points, double size) {
  std::vector<TensorOfEach<Scalar>> gradients(points);
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t k = 0; k < 9; ++k) {
      for (std::size_t m = 0; m < members; ++m) {
        gradients[i].entry[k][m] = static_cast<Scalar>(size * std::sin(static_cast<double>(7 * i + 3 * k * k + 5 * m)));
      }
    }
  }
  return gradients;
}

template <class Scalar>
void expect_law(const EachKernels& kernels, double rounding) {
  constexpr std::size_t points = 3;
  const std::vector<TensorOfEach<Scalar>> gradients = some_gradients<Scalar>(points, 0.2);
  std::vector<NumberOfEach<double>> dilatation(points), pressure(points);
  NumberOfEach<double> smallest = {}, shear;
  const double volume[points] = {1, 2, 3};
  for (std::size_t m = 0; m < members; ++m) {
    shear.of[m] = 100 + 10 * static_cast<double>(m);
    for (std::size_t i = 0; i < points; ++i) {
      pressure[i].of[m] = 50 * static_cast<double>(i) - 30;
    }
  }
  std::vector<TensorOfEach<Scalar>> stress = gradients;
  kernels.of<Scalar>().dilatation(gradients.data(), points, dilatation.data(), smallest);
  kernels.of<Scalar>().neo_hookean(stress.data(), points, shear, pressure.data(), volume);
  for (std::size_t m = 0; m < members; ++m) {
    double least = 0;
    for (std::size_t i = 0; i < points; ++i) {
      Eigen::Matrix3d f;
      for (std::size_t k = 0; k < 9; ++k) {
        f.data()[k] = (k % 4 == 0 ? 1 : 0) + static_cast<double>(gradients[i].entry[k][m]);
      }
      const Deformation d(f);
      NeoHookean law{Material{}};
      law.shear_modulus = shear.of[m];
      const Eigen::Matrix3d expected =
          volume[i] * (law.isochoric_stress(d) + pressure[i].of[m] * law.dilatation_slope(d));
      EXPECT_NEAR(dilatation[i].of[m], d.jacobian - 1, 1e-14) << kernels.name;
      least = std::min(least, d.jacobian - 1);
      for (std::size_t k = 0; k < 9; ++k) {
        EXPECT_NEAR(stress[i].entry[k][m], expected.data()[k], rounding * expected.norm()) << kernels.name;
      }
    }
    EXPECT_NEAR(smallest.of[m], least, 1e-14);
  }
}

/// Two points that see three and six of four nodes' slots, padded to quads.
template <class Scalar>
void expect_passes(const EachKernels& kernels, double rounding) {
  const std::vector<std::int64_t> begin = {0, 4, 12};
  const std::vector<std::uint16_t> slot = {0, 2, 3, 0, 1, 3, 0, 2, 1, 3, 1, 1};
  std::vector<Scalar> derivative;
  for (std::size_t pair = 0; pair < slot.size(); ++pair) {
    const bool padding = pair == 3 || pair > 9;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      derivative.push_back(padding ? Scalar{0} : static_cast<Scalar>(std::cos(static_cast<double>(3 * pair + axis))));
    }
  }
  std::vector<VectorOfEach<Scalar>> displacement(4), force(4);
  for (std::size_t node = 0; node < 4; ++node) {
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t m = 0; m < members; ++m) {
        displacement[node].of[row][m] = static_cast<Scalar>(std::sin(static_cast<double>(node + 5 * row + 11 * m)));
        force[node].of[row][m] = static_cast<Scalar>(m);  // what is there stays
      }
    }
  }
  const PairRows<Scalar> rows{begin.data(), slot.data(), derivative.data()};
  std::vector<TensorOfEach<Scalar>> gradient(2);
  kernels.of<Scalar>().gradients(rows, 0, 2, displacement.data(), gradient.data());
  kernels.of<Scalar>().spread(rows, 0, 2, gradient.data(), force.data());
  for (std::size_t m = 0; m < members; ++m) {
    Eigen::Matrix<double, 3, 4> expected_force = Eigen::Matrix<double, 3, 4>::Constant(static_cast<double>(m));
    for (std::size_t p = 0; p < 2; ++p) {
      const auto first = static_cast<std::size_t>(begin[p]), last = static_cast<std::size_t>(begin[p + 1]);
      const auto b = [&](std::size_t pair) {
        return Eigen::Map<const Eigen::Matrix<Scalar, 3, 1>>(&derivative[3 * pair]).template cast<double>().eval();
      };
      Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
      for (std::size_t pair = first; pair < last; ++pair) {
        const auto& u = displacement[slot[pair]].of;
        h += Eigen::Vector3d(u[0][m], u[1][m], u[2][m]) * b(pair).transpose();
      }
      for (std::size_t k = 0; k < 9; ++k) {
        EXPECT_NEAR(gradient[p].entry[k][m], h.data()[k], rounding) << kernels.name;
      }
      for (std::size_t pair = first; pair < last; ++pair) {
        expected_force.col(slot[pair]) += h * b(pair);
      }
    }
    for (std::size_t node = 0; node < 4; ++node) {
      for (std::size_t row = 0; row < 3; ++row) {
        EXPECT_NEAR(force[node].of[row][m],
                    expected_force(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(node)), 30 * rounding);
      }
    }
  }
}

TEST(EachKernels, PassOverPairsAsSumsSayOnAllInstructionSets) {
  for (const EachKernels& kernels : each_kernels()) {
    expect_passes<double>(kernels, 1e-14);
    expect_passes<float>(kernels, 2e-6);
  }
}

TEST(EachKernels, AnswerAsTheLawDoesOnAllInstructionSets) {
  ASSERT_EQ(each_kernels().size(), step_kernels().size());
  for (const EachKernels& kernels : each_kernels()) {
    expect_law<double>(kernels, 1e-13);
    expect_law<float>(kernels, 1e-6);
  }
}

TEST(EachKernels, KeepAPointInsideOutToItsMember) {
  for (const EachKernels& kernels : each_kernels()) {
    std::vector<TensorOfEach<double>> tensor = some_gradients<double>(2, 0.1);
    for (std::size_t k = 0; k < 9; ++k) {
      tensor[0].entry[k][5] = k % 4 == 0 ? -2 : 0;  // J = -1
    }
    tensor[0].entry[0][6] = std::numeric_limits<double>::quiet_NaN();
    std::vector<NumberOfEach<double>> dilatation(2), pressure(2, NumberOfEach<double>{});
    NumberOfEach<double> smallest = {}, shear;
    std::fill_n(shear.of, members, 100.0);
    const double volume[] = {1, 1};
    kernels.of<double>().dilatation(tensor.data(), 2, dilatation.data(), smallest);
    EXPECT_NEAR(smallest.of[5], -2, 1e-14);
    EXPECT_TRUE(std::isnan(smallest.of[6]));
    EXPECT_GT(smallest.of[4], -0.9);
    kernels.of<double>().neo_hookean(tensor.data(), 2, shear, pressure.data(), volume);
    EXPECT_TRUE(std::isnan(tensor[0].entry[0][5]));
    EXPECT_FALSE(std::isnan(tensor[0].entry[0][4]));
  }
}

}  // namespace brainshift::solve::each_kernels_test
