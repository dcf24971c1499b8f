// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/relaxation_rules.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "solve/dynamics/relaxation.hpp"
#include "solve/material/material_table.hpp"

namespace brainshift::solve::relaxation_rules_test {

/// Of a body of these tissues.
int steps(std::vector<double> poisson_ratios, bool plane_stress = false, int asked = 400) {
  PointLaws laws;
  for (const double ratio : poisson_ratios) {
    laws.elastic.push_back(elastic_law({.poisson_ratio = ratio}));
  }
  laws.plane_stress = plane_stress;
  return steps_of_load(asked, laws);
}

TEST(StepsOfLoad, AreThoseThatAreAskedForWhereVolumeAndShapeGiveWayAlike) {
  EXPECT_EQ(steps({0.0}), 400);
  EXPECT_EQ(steps({0.49}), 400);
  EXPECT_EQ(steps({0.495}), 400);
}

TEST(StepsOfLoad, AreMoreWhereShearIsSlowerUpToABound) {
  EXPECT_NEAR(steps({0.45, 0.498}), 400 * std::sqrt(2.497), 1);  // K / µ = 2 (1 + ν) / 3 (1 − 2ν) = 249.7
  EXPECT_NEAR(steps({0.4999}), 400 * std::sqrt(5.0), 1);
  EXPECT_EQ(steps({0.4999}), steps({0.49999}));
  EXPECT_EQ(steps({0.4999}, false, std::numeric_limits<int>::max()), std::numeric_limits<int>::max());
}

TEST(StepsOfLoad, AreThoseThatAreAskedForInPlaneStress) {
  EXPECT_EQ(steps({0.4999}, true), 400);
}

TEST(WantedBound, OfWhatDoesNotMoveIsTheTolerance) {
  EXPECT_EQ(wanted_bound(0.01, 1e-6), 2e-8);
  EXPECT_EQ(wanted_bound(0.01, 2e-14), 0.01) << "what is left of a rigid motion that was taken out";
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    EXPECT_GE(rounding_of_step(2e-14, precision), 1e-14);
    EXPECT_LT(rounding_of_step(1e-6, precision), 1e-11);
  }
}

/// Steps until a mode of this eigenvalue stays within a thousandth of where it started, in a body of this A_0.
int steps_of_mode(double eigenvalue, double lowest, bool quick_ones_first) {
  double now = 1, before = 1;
  int last = 0;
  for (int n = 0; n < 20'000; ++n) {
    const int looked = n / usual_window * usual_window;
    const double beta = critical_beta(damped_eigenvalue(lowest, looked, quick_ones_first));
    const double next = now + beta * (now - before) - relaxation_alpha * eigenvalue * now;
    before = std::exchange(now, next);
    last = std::abs(now) > 1e-3 ? n : last;
  }
  return last;
}

TEST(DampedEigenvalue, LetsQuickMotionsDieFirstAndHoldsTheSlowestUpByATenthAtMost) {
  constexpr double lowest = 1e-6;
  EXPECT_LT(4 * steps_of_mode(1e-2, lowest, true), steps_of_mode(1e-2, lowest, false));
  EXPECT_LT(2 * steps_of_mode(1e-3, lowest, true), steps_of_mode(1e-3, lowest, false));
  EXPECT_LT(steps_of_mode(lowest, lowest, true), 1.1 * steps_of_mode(lowest, lowest, false));
}

TEST(SinglePrecision, IsOutlastedSoonerByWhatMovesFartherOrIsWantedNearer) {
  const auto steps = [](double farthest, double wanted) {
    int n = 0;
    while (!outlasts(Precision::single_precision, n, farthest, wanted)) {
      n += usual_window;
    }
    return n;
  };
  EXPECT_NEAR(steps(10, 0.01), 1400, 40) << "a head takes up to 980";
  EXPECT_NEAR(steps(40, 0.01), steps(10, 0.01) / 2, 40);
  EXPECT_NEAR(steps(10, 0.0025), steps(10, 0.01) / 2, 40);
  EXPECT_FALSE(outlasts(Precision::double_precision, 1'000'000, 10, 0.01));
}

}  // namespace brainshift::solve::relaxation_rules_test
