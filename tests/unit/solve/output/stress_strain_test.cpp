// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/stress_strain.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/cut_bodies.hpp"

namespace brainshift::solve::stress_strain_test {

/// A state after so much of the time, with a reaction along x, N.
HistoryRow state(double time, double reaction, double residual = 0) {
  HistoryRow row;
  row.time = time;
  row.reaction = {reaction, 0.7, 0};
  row.residual = residual;
  return row;
}

/// The strip is 30 mm long, 20 mm wide and 1 mm thick; its end is pulled by 15 mm.
TEST(StressStrain, IsTheReactionOverTheMeanSectionAndTheElongationOverTheLength) {
  Model model = test::strip(1.5);
  model.curve = LoadCurve({0, 2}, {0, 1}, LoadCurve::Join::straight);
  const auto curve = stress_strain(model, Dynamics::transient, {state(0, 0), state(0.5, 0.01), state(2, 0.04)});
  ASSERT_EQ(curve.size(), 3U);
  EXPECT_EQ(curve[1].time, 0.5);
  EXPECT_NEAR(curve[1].elongation, 0.125, 1e-12);
  EXPECT_NEAR(curve[2].elongation, 0.5, 1e-12);
  EXPECT_NEAR(curve[1].stress, 0.01 / 20 * 1e6, 1e-9);
  EXPECT_NEAR(curve[2].stress, 0.04 / 20 * 1e6, 1e-9);
}

/// Relaxation counts the time as a share of the curve.
TEST(StressStrain, OfRelaxationIsThatOfStatesAtRestAndOfTheLast) {
  Model model = test::strip(1.5);
  model.curve = LoadCurve({0, 10}, {0, 1}, LoadCurve::Join::straight);
  std::vector<HistoryRow> history;
  for (const double residual : {0.01, 0.01, 0.01, 0.01, 0.3, 0.01, 0.01, 0.01, 0.5}) {
    history.push_back(state(0.1 * static_cast<double>(history.size() + 1), 0.01, residual));
  }
  const auto curve = stress_strain(model, Dynamics::relaxation, history);
  ASSERT_EQ(curve.size(), 2U) << "the fourth calm row in turn, and the last";
  EXPECT_NEAR(curve[0].time, 0.4, 1e-12);
  EXPECT_NEAR(curve[0].elongation, 0.2, 1e-12);
  EXPECT_NEAR(curve[1].time, 0.9, 1e-12);
  EXPECT_EQ(stress_strain(model, Dynamics::transient, history).size(), 9U);
}

TEST(StressStrain, IsAlongThePullWhateverItsDirection) {
  Model model = test::strip(1.5);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {  // the same body pulled along −x
    auto prescribed = model.conditions.displacement.row(a);
    prescribed[0] = prescribed[0] > 0 ? 0 : prescribed[0] == 0 ? -15 : prescribed[0];
  }
  const auto curve = stress_strain(model, Dynamics::transient, {state(1, -0.04)});
  EXPECT_NEAR(curve[0].elongation, 0.5, 1e-12);
  EXPECT_NEAR(curve[0].stress, 0.04 / 20 * 1e6, 1e-9);
}

TEST(StressStrain, NeedsAPullAtOneEnd) {
  Model model = test::strip(1);
  EXPECT_TRUE(stress_strain(model, Dynamics::relaxation, {state(1, 0)}).empty());
  model.conditions.displacement.col(0).array() -= 7;  // one end by −7, the other by 8 mm
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    model.conditions.displacement(a, 0) += model.cloud.positions(a, 0) > 0 ? 15 : 0;
  }
  EXPECT_TRUE(stress_strain(model, Dynamics::relaxation, {state(1, 0)}).empty());
  model.conditions.displacement.setConstant(std::nan(""));
  EXPECT_TRUE(stress_strain(model, Dynamics::relaxation, {state(1, 0)}).empty());
}

TEST(StressStrain, IsWrittenAsATable) {
  const test::ScratchFolder folder;
  write_stress_strain(folder / "stress_strain.csv", {{0, 0, 0}, {0.5, 0.125, 500.25}});
  EXPECT_EQ(test::bytes_of(folder / "stress_strain.csv"), "time,elongation,stress_Pa\n0,0,0\n0.5,0.125,500.25\n");
  EXPECT_THROW(write_stress_strain(folder / "none" / "x.csv", {}), std::runtime_error);
}

}  // namespace brainshift::solve::stress_strain_test
