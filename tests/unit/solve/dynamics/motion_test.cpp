// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/dynamics/motion.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "solve/force/largest_eigenvalue.hpp"
#include "solve/force/stiffness_bound.hpp"
#include "tests/unit/solve/chapter_critical_step.hpp"
#include "tests/unit/solve/specimen_body.hpp"

namespace brainshift::solve::motion_test {

constexpr double side = 30;

Body pulled_body(const Specimen& box, double pull) {
  Body body = free_body(box);
  NodalVectors external = box.rest();
  for (std::size_t a = 0; a < box.cloud.size(); ++a) {
    external[4 * a + 2] = pull * (box.cloud.positions(static_cast<Eigen::Index>(a), 2) - side / 2);
  }
  body.external = ExternalForce(std::move(external));
  return body;
}

/// A box under forces that pull its top, `pull` times as large as its spacing asks for, marched with a step of
/// `of_critical` times the true critical one.
struct Marched {
  Specimen box{test::irregular_box(5, side), test::box_cells(4, side), {Material{}}, SpecimenOptions{}};
  SteppingResult result;
  int sound_steps = 0;

  explicit Marched(double of_critical, double pull = 1) {
    const std::vector<double> mass = chapter_mass(box.points, std::vector<double>{1e-3});
    Motion motion(pulled_body(box, pull), 0);
    const PointLaws& laws = motion.body.laws;
    motion.weigh(mass);
    const double h = of_critical * 2 / std::sqrt(largest_eigenvalue(box.points, laws, mass, 300));
    while (motion.result.failure.empty() && motion.result.steps < 2000) {
      const double time = motion.time + h;
      motion.step(laws, mass, h * h, 1, time, std::min(1.0, 100 * time));
      if (motion.result.steps % 10 == 0 && motion.look(laws, mass, 0.05)) {
        sound_steps = motion.result.steps;
      }
    }
    result = motion.finish();
  }
};

TEST(Motion, BalancesItsEnergiesJustBelowTheCriticalStep) {
  const Marched marched(0.98);
  EXPECT_EQ(marched.result.failure, "");
  EXPECT_EQ(marched.sound_steps, 2000);
}

/// What rounding makes of the energies of a hardly loaded body is no instability.
TEST(Motion, IsSoundUnderAForceNextToNothing) {
  for (const double pull : {1e-6, 1e-9, 1e-12}) {
    EXPECT_EQ(Marched(0.9, pull).result.failure, "") << pull;
  }
}

/// The fastest motions turn from step to step: their energy is that of the velocities before and after, not of the
/// mean.
TEST(Motion, BalancesTheEnergiesOfItsFastestMotions) {
  const Marched pulled(0.9, 1e-2);
  double most = 0;
  for (const HistoryRow& row : pulled.result.history) {
    most = std::max(most, row.strain_energy);
  }
  for (const HistoryRow& row : pulled.result.history) {
    EXPECT_NEAR(row.strain_energy + row.kinetic_energy + row.dissipated_energy, row.external_work, 1e-4 * most)
        << "at step " << row.step;
  }
}

TEST(Motion, IsFoundUnstableJustAboveTheCriticalStepAndKeepsTheLastGoodState) {
  for (const double of_critical : {1.03, 1.5}) {
    const Marched marched(of_critical);
    EXPECT_TRUE(marched.result.unstable) << of_critical;
    EXPECT_NE(marched.result.failure.find("unstable at step"), std::string::npos) << marched.result.failure;
    EXPECT_LT(marched.result.steps, 2000);
    double largest = 0;
    for (const double u : marched.result.parameters) {
      ASSERT_TRUE(std::isfinite(u));
      largest = std::max(largest, std::abs(u));
    }
    EXPECT_LT(largest, side / 10);
  }
}

TEST(Motion, KeepsTheSwellingOfTheMomentWhenItsBodyChanges) {
  const Specimen box{
      test::irregular_box(4, side), test::box_cells(3, side), {Material{.swelling = 0.3}}, SpecimenOptions{}};
  Motion motion(pulled_body(box, 1), 0);
  const PointLaws laws = motion.body.laws;
  const std::vector<double> mass = chapter_mass(box.points, std::vector<double>{1e-3});
  motion.weigh(mass);
  const double h = 0.1 / std::sqrt(largest_eigenvalue(box.points, laws, mass, 300));
  motion.step(laws, mass, h * h, 1, h, 0.5);
  BodyChange change;
  change.next = [](const Moment& moment) {
    std::vector<std::int32_t> point_from(moment.body.points.volume.size());
    std::iota(point_from.begin(), point_from.end(), 0);
    return moment.first ? std::optional<ChangedBody>({moment.body, std::identity(), std::move(point_from)})
                        : std::nullopt;
  };
  ASSERT_TRUE(motion.change(change, laws, motion.time, true));
  EXPECT_NEAR(motion.scratch.growth_of(0), std::cbrt(1 + 0.5 * 0.3), 1e-14);
}

}  // namespace brainshift::solve::motion_test
