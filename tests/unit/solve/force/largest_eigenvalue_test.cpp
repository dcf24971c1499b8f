// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/largest_eigenvalue.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Eigenvalues>

#include "solve/force/stiffness_bound.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve::largest_eigenvalue_test {

/// Hundreds of forces of a body of 27 nodes: threads would only wait for each other.
class OneThread : public testing::Test {
 protected:
  OneThread() { omp_set_num_threads(1); }
  ~OneThread() override { omp_set_num_threads(threads_); }

 private:
  int threads_ = omp_get_max_threads();
};
class LargestEigenvalue : public OneThread {};
class BoundTightness : public OneThread {};

Specimen small_box() {
  return {test::irregular_box(3, 30), test::box_cells(2, 30.0), {{.poisson_ratio = 0.45}}, {}};
}

/// Masses from 1 to 2.
std::vector<double> uneven_mass(std::size_t nodes) {
  std::vector<double> mass;
  for (std::size_t a = 0; a < nodes; ++a) {
    mass.push_back(1 + static_cast<double>(a % 7) / 6);
  }
  return mass;
}

/// Of M^(-1/2) K M^(-1/2), K by central differences of the forces, all of it.
double dense_eigenvalue(Specimen& body, const std::vector<double>& mass) {
  constexpr double step = 1e-5;
  const std::size_t n = body.cloud.size();
  Eigen::MatrixXd k(static_cast<Eigen::Index>(3 * n), static_cast<Eigen::Index>(3 * n));
  for (std::size_t b = 0; b < n; ++b) {
    for (std::size_t j = 0; j < 3; ++j) {
      NodalVectors ahead = body.rest(), behind = ahead;
      ahead[4 * b + j] = step;
      behind[4 * b + j] = -step;
      const NodalVectors high = body.force(ahead), low = body.force(behind);
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t i = 0; i < 3; ++i) {
          k(static_cast<Eigen::Index>(3 * a + i), static_cast<Eigen::Index>(3 * b + j)) =
              (high[4 * a + i] - low[4 * a + i]) / (2 * step) / std::sqrt(mass[a] * mass[b]);
        }
      }
    }
  }
  const Eigen::MatrixXd symmetric = (k + k.transpose()) / 2;
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

TEST_F(LargestEigenvalue, ComesFromBelowToThatOfTheMatrix) {
  Specimen body = small_box();
  const std::vector<double> mass = uneven_mass(body.cloud.size());
  const double exact = dense_eigenvalue(body, mass);
  double before = 0;
  for (const int iterations : {5, 40, 300}) {
    const double found = largest_eigenvalue(body.points, body.laws, mass, iterations);
    EXPECT_LE(found, (1 + 1e-6) * exact);
    EXPECT_GE(found, before);
    before = found;
  }
  EXPECT_GE(before, 0.999 * exact) << "a few hundred iterations are nearly exact";
  EXPECT_GE(largest_eigenvalue(body.points, body.laws, mass, 40), 0.9 * exact) << "forty some percent short";
}

TEST_F(LargestEigenvalue, IsHalfWithTwiceTheMass) {
  const Specimen body = small_box();
  const std::vector<double> light(body.cloud.size(), 1), heavy(body.cloud.size(), 2);
  const double of_light = largest_eigenvalue(body.points, body.laws, light, 40);
  EXPECT_NEAR(largest_eigenvalue(body.points, body.laws, heavy, 40), of_light / 2, 1e-6 * of_light);
}

TEST_F(BoundTightness, IsTheEigenvalueWithAMarginOverTheBound) {
  Specimen body = small_box();
  body.force(body.rest());
  const std::vector<double> mass = uneven_mass(body.cloud.size());
  std::vector<double> bound = stiffness_bound(body.points, body.laws, body.scratch);
  double largest = 0;
  for (std::size_t a = 0; a < mass.size(); ++a) {
    largest = std::max(largest, bound[a] / mass[a]);
  }
  const double tightness = bound_tightness(body.points, body.laws, bound, mass);
  EXPECT_LT(tightness, 1);
  EXPECT_GE(tightness * largest, largest_eigenvalue(body.points, body.laws, mass, 300))
      << "the margin makes up for what iteration is short of";
  EXPECT_NEAR(tightness * largest, 1.25 * largest_eigenvalue(body.points, body.laws, mass, 40), 1e-9 * largest);
  for (double& d : bound) {
    d /= 1000;
  }
  EXPECT_EQ(bound_tightness(body.points, body.laws, bound, mass), 1) << "never above the bound";
}

}  // namespace brainshift::solve::largest_eigenvalue_test
