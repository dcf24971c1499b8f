// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/viscous.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "solve/material/elastic_law.hpp"
#include "tests/unit/solve/material_cases.hpp"

namespace brainshift::solve::viscous_test {

const std::vector<PronyTerm> brain_prony = {{0.450, 0.50}, {0.365, 50}};

/// A point with its state.
struct Point {
  ElasticLaw law;
  std::vector<double> state = std::vector<double>(viscous_state_size(brain_prony.size()));

  Eigen::Matrix3d move(const Eigen::Matrix3d& f, const PronyStep& step) {
    return std::visit([&](const auto& l) { return viscous_stress(l, step, Deformation(f), state); }, law);
  }
  Eigen::Matrix3d move(const Eigen::Matrix3d& f, double time_step) {
    return move(f, PronyStep(brain_prony, time_step));
  }
};

using Motion = std::function<Eigen::Matrix3d(double time)>;

Eigen::Matrix3d stress_after(const ElasticLaw& law, const Motion& motion, double end, int steps) {
  Point point{law};
  const PronyStep step(brain_prony, end / steps);
  Eigen::Matrix3d stress;
  for (int n = 1; n <= steps; ++n) {
    stress = point.move(motion(end * n / steps), step);
  }
  return stress;
}

class EveryViscousLaw : public testing::TestWithParam<Material> {
 protected:
  const ElasticLaw law = elastic_law(GetParam());
  const Eigen::Matrix3d deformed = random_deformation(5);
};

INSTANTIATE_TEST_SUITE_P(Material, EveryViscousLaw, testing::ValuesIn(every_law),
                         [](const auto& tested) { return name_of(tested.param); });

TEST_P(EveryViscousLaw, AStepStrainRelaxesAsThePronySeriesSays) {
  Point point{law};
  point.move(deformed, 1e-12);
  double time = 0;
  for (const double time_step : {1e-6, 1e-3, 0.1, 0.1, 1.0, 30.0, 1000.0}) {  // exact, whatever the step
    time += time_step;
    const double left = 1 - 0.450 * (1 - std::exp(-time / 0.50)) - 0.365 * (1 - std::exp(-time / 50));
    const Eigen::Matrix3d expected = left * isochoric_stress(law, deformed);
    EXPECT_LE((point.move(deformed, time_step) - expected).norm(), 1e-10 * expected.norm()) << time;
  }
}

TEST_P(EveryViscousLaw, AFastLoadMeetsTheElasticLawAndASlowOneTheLongTermMaterial) {
  const Motion ramp = [&](double share) -> Eigen::Matrix3d {
    return (1 - share) * Eigen::Matrix3d::Identity() + share * deformed;
  };
  const Eigen::Matrix3d elastic = isochoric_stress(law, deformed);
  const Eigen::Matrix3d fast = stress_after(
      law, [&](double t) { return ramp(t / 1e-7); }, 1e-7, 20);
  EXPECT_LE((fast - elastic).norm(), 1e-6 * elastic.norm());

  Material relaxing = GetParam();
  relaxing.prony = brain_prony;
  const Eigen::Matrix3d lasting = isochoric_stress(elastic_law(long_term(relaxing)), deformed);
  const Eigen::Matrix3d slow = stress_after(
      law, [&](double t) { return ramp(t / 1e10); }, 1e10, 20);
  EXPECT_LE((slow - lasting).norm(), 1e-6 * lasting.norm());
}

TEST_P(EveryViscousLaw, ErrorFallsWithTheSquareOfTheStep) {
  const Motion motion = [&](double t) -> Eigen::Matrix3d {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5 * t, Eigen::Vector3d(1, 2, 2) / 3).toRotationMatrix();
    return turn * (Eigen::Matrix3d::Identity() + std::sin(2 * t) * (deformed - Eigen::Matrix3d::Identity()));
  };
  const Eigen::Matrix3d exact = stress_after(law, motion, 1, 4000);
  const double coarse = (stress_after(law, motion, 1, 20) - exact).norm();
  const double fine = (stress_after(law, motion, 1, 40) - exact).norm();
  EXPECT_NEAR(coarse / fine, 4, 0.2);
  EXPECT_LE(coarse, 3e-3 * exact.norm());
}

TEST_P(EveryViscousLaw, AClosedCycleTakesWork) {
  for (const double period : {0.01, 1.0, 100.0, 1e4}) {
    Point point{law};
    constexpr int steps = 400;
    const PronyStep step(brain_prony, period / steps);
    Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
    for (int cycle = 0; cycle < 4; ++cycle) {
      double work = 0;
      double turnover = 0;
      for (int n = 1; n <= steps; ++n) {
        const double phase = 2 * std::numbers::pi * n / steps;
        Eigen::Matrix3d next = Eigen::Matrix3d::Identity();
        next(0, 1) = 0.3 * std::sin(phase);
        next(2, 2) += 0.2 * (1 - std::cos(phase));
        const Eigen::Matrix3d next_stress = point.move(next, step);
        const double part = 0.5 * (stress + next_stress).cwiseProduct(next - f).sum();
        work += part;
        turnover += std::abs(part);
        f = next;
        stress = next_stress;
      }
      EXPECT_GT(work, 0) << period;
      EXPECT_LT(work, turnover);
    }
  }
}

TEST(Viscous, RelaxationTurnsWithTheBody) {
  const ElasticLaw law = elastic_law({.law = Law::ogden, .ogden = {{842, -4.7}}});
  const Motion motion = [](double t) -> Eigen::Matrix3d {
    return Eigen::Matrix3d::Identity() + t * (random_deformation(5) - Eigen::Matrix3d::Identity());
  };
  const auto turn = [](double t) { return Eigen::AngleAxisd(2 * t, Eigen::Vector3d::UnitX()).toRotationMatrix(); };
  const Motion turning = [&](double t) -> Eigen::Matrix3d { return turn(t) * motion(t); };
  const Eigen::Matrix3d stress = stress_after(law, motion, 1, 50);
  EXPECT_LE((stress_after(law, turning, 1, 50) - turn(1) * stress).norm(), 1e-12 * stress.norm());
}

TEST(Viscous, TinyStepsLoseNoDigits) {
  const ElasticLaw law = elastic_law({});
  const Eigen::Matrix3d f = random_deformation(5);
  Point point{law};
  point.move(f, 1e-12);
  constexpr int steps = 100000;
  const PronyStep step(brain_prony, 1e-9);
  Eigen::Matrix3d stress;
  for (int n = 0; n < steps; ++n) {
    stress = point.move(f, step);
  }
  const double time = 1e-9 * steps;
  const double lost = 0.450 * -std::expm1(-time / 0.50) + 0.365 * -std::expm1(-time / 50);
  const Eigen::Matrix3d elastic = isochoric_stress(law, f);
  EXPECT_NEAR((elastic - stress).norm() / elastic.norm() / lost, 1, 1e-6);
}

TEST(Viscous, WithoutTermsIsElastic) {
  const NeoHookean law{Material{}};
  const Deformation d(random_deformation(5));
  std::vector<double> state(viscous_state_size(0));
  EXPECT_LE((viscous_stress(law, PronyStep({}, 0.1), d, state) - law.isochoric_stress(d)).norm(),
            1e-13 * law.isochoric_stress(d).norm());
}

}  // namespace brainshift::solve::viscous_test
