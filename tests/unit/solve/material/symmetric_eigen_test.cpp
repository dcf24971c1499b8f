// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/symmetric_eigen.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace brainshift::solve::symmetric_eigen_test {

Eigen::Vector3d sorted(Eigen::Vector3d values) {
  std::sort(values.begin(), values.end());
  return values;
}

void expect_decomposed(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& expected) {
  const SymmetricEigen eigen = symmetric_eigen(matrix);
  const double tolerance = 1e-14 * matrix.norm();
  EXPECT_LE((sorted(eigen.values) - sorted(expected)).norm(), tolerance) << expected.transpose();
  EXPECT_LE((eigen.vectors.transpose() * eigen.vectors - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_LE((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose() - matrix).norm(), tolerance);
}

TEST(SymmetricEigen, HoldsWhereverEigenvaluesMeet) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const double gap : {1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-13, 1e-16, 0.0}) {
    for (int i = 0; i < 200; ++i) {
      const Eigen::Matrix3d turn =
          Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().matrix();
      for (const Eigen::Vector3d& values :
           {Eigen::Vector3d(1, 1 + gap, 1 - 2 * gap), Eigen::Vector3d(1, 1 + gap, -2), Eigen::Vector3d(-1, -1 + gap, 2),
            Eigen::Vector3d(gap, 0, 1), Eigen::Vector3d(gap, -gap, 0)}) {
        const Eigen::Matrix3d matrix = turn * values.asDiagonal() * turn.transpose();
        expect_decomposed((matrix + matrix.transpose()) / 2, values);
      }
    }
  }
}

TEST(SymmetricEigen, HoldsForDiagonalAndForTinyMatrices) {
  for (const double scale : {1.0, 1e-20, 1e-150, 1e-290, 1e150}) {
    expect_decomposed(scale * Eigen::Vector3d(1, 2, 3).asDiagonal(), scale * Eigen::Vector3d(1, 2, 3));
    expect_decomposed(scale * Eigen::Vector3d(-1, -1, 3).asDiagonal(), scale * Eigen::Vector3d(-1, -1, 3));
  }
  expect_decomposed(Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero());
  expect_decomposed(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Ones());
  Eigen::Matrix3d nearly_diagonal = Eigen::Vector3d(1, 1, 2).asDiagonal();
  nearly_diagonal(0, 1) = nearly_diagonal(1, 0) = 1e-200;
  expect_decomposed(nearly_diagonal, Eigen::Vector3d(1, 1, 2));
}

TEST(SymmetricEigen, DoesNotHideANaN) {
  for (int i = 0; i < 9; ++i) {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
    matrix.reshaped()[i] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(symmetric_eigen(matrix).values.sum()));
  }
}

}  // namespace brainshift::solve::symmetric_eigen_test
