// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/lowest_eigenvalue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "tests/unit/solve/specimen_body.hpp"

namespace brainshift::solve::lowest_eigenvalue_test {

constexpr double side = 30, alpha = 3;

/// A box that nothing holds, one step after it lay undeformed.
struct Stepped {
  Specimen box{test::irregular_box(4, side), test::box_cells(3, side), {Material{}}, SpecimenOptions{}};
  Motion motion{free_body(box), 0};
  std::vector<double> mass = std::vector<double>(box.cloud.size(), 1.0);

  /// Masses for a quotient of this.
  explicit Stepped(double wanted) {
    motion.before = box.random_parameters(1e-6);
    motion.force = box.force(motion.before);
    double stiffness = 0, inertia = 0;
    for (std::size_t a = 0; a < box.cloud.size(); ++a) {
      stiffness += at(motion.before, a).dot(at(motion.force, a));
      inertia += at(motion.before, a).squaredNorm();
    }
    std::fill(mass.begin(), mass.end(), stiffness / inertia / wanted);
    motion.weigh(mass, alpha);
    motion.time = 1;
  }
};

TEST(LowestEigenvalue, IsRayleighsQuotientOfTheLastIncrement) {
  for (const double wanted : {1e-5, 1e-3, 0.02}) {
    const Stepped stepped(wanted);
    LowestEigenvalue lowest(stepped.box.cloud.size());
    lowest.estimate(stepped.motion, stepped.mass, alpha, false, false);
    EXPECT_NEAR(lowest.value(), wanted, 1e-9 * wanted);
  }
}

TEST(LowestEigenvalue, OfAnUpdateOnlyGoesDown) {
  const Stepped stepped(1e-3);
  LowestEigenvalue lowest(stepped.box.cloud.size());
  lowest.hold(2e-3);
  lowest.estimate(stepped.motion, stepped.mass, alpha, false, true);
  EXPECT_NEAR(lowest.value(), 1e-3, 1e-9);
  lowest.hold(5e-4);
  lowest.estimate(stepped.motion, stepped.mass, alpha, false, true);
  EXPECT_EQ(lowest.value(), 5e-4);
}

NodalVectors sum(NodalVectors a, const NodalVectors& b) {
  std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<>());
  return a;
}

/// Where the last increment is rounding, which stirs quick motions up, that since the last look counts if it is slower.
TEST(LowestEigenvalue, GoesByTheLastWindowWhereIncrementsAreRounding) {
  Stepped stepped(0.02);
  Motion& motion = stepped.motion;
  const NodalVectors look = motion.before;
  const NodalVectors slow = stepped.box.linear(1e-6 * Eigen::Vector3d::UnitX() * Eigen::RowVector3d::UnitY());  // shear
  const NodalVectors quick = stepped.box.random_parameters(1e-9, 5);
  const auto value = [&](bool rounding_is_felt) {
    motion.before = look;
    motion.force = stepped.box.force(look);
    LowestEigenvalue lowest(stepped.box.cloud.size());
    lowest.estimate(motion, stepped.mass, alpha, false, false);
    motion.next = sum(look, slow);
    motion.force = stepped.box.force(motion.next);
    lowest.keep_force(motion);
    motion.before = sum(motion.next, quick);
    motion.force = stepped.box.force(motion.before);
    lowest.estimate(motion, stepped.mass, alpha, rounding_is_felt, false);
    return lowest.value();
  };
  const NodalVectors resisting = stepped.box.force(slow);
  double stiffness = 0, inertia = 0;
  for (std::size_t a = 0; a < stepped.mass.size(); ++a) {
    stiffness += at(slow, a).dot(at(resisting, a));
    inertia += stepped.mass[a] * at(slow, a).squaredNorm();
  }
  EXPECT_NEAR(value(true), stiffness / inertia, 0.02 * stiffness / inertia);
  EXPECT_GT(value(false), 2 * value(true));
}

}  // namespace brainshift::solve::lowest_eigenvalue_test
