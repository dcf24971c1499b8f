// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/outliers.hpp"

#include <gtest/gtest.h>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/measured_box.hpp"

namespace brainshift::solve::outliers_test {

TEST(Outliers, AreThePointsThatContradictTheOthersAndNoneWhereAllAgree) {
  Model model = measured_box(0.5);
  EXPECT_TRUE(outliers(thinned_body(model, {}), model.conditions).empty());
  Measurement& measured = *model.conditions.measured;
  const Eigen::Index wrong = measured.cortex.rows() / 2;
  measured.cortex_displacement.row(wrong) << 30, 0, -4;
  const std::vector<Outlier> found = outliers(thinned_body(model, {}), model.conditions);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].position, measured.cortex.row(wrong).transpose());
  EXPECT_GT(found[0].deviations, 5);
}

/// Each makes the other less surprising.
TEST(Outliers, AreTwoWrongNeighboursThatAgree) {
  Model model = measured_box(0.5);
  Measurement& measured = *model.conditions.measured;
  const Eigen::Index wrong = measured.cortex.rows() / 2;
  for (const Eigen::Index i : {wrong, wrong + 1}) {
    measured.cortex_displacement.row(i) += Eigen::RowVector3d(8, 0, -6);
  }
  EXPECT_EQ(outliers(thinned_body(model, {}), model.conditions).size(), 2U);
}

/// One near what moves is as no other is, and right.
TEST(Outliers, AreNoneOfPointsInsideAloneWhichCountInFull) {
  Model model = measured_box(0.5);
  Measurement& measured = *model.conditions.measured;
  const Points places = test::random_points(12, 30).array() + 15;
  CraniotomyLoad inside{places, Points::Zero(12, 3), Points::Constant(12, 3, 0.5)};
  inside.displacement.row(0) << 0, 0, -9;
  measured.cortex = measured.cortex_displacement = measured.sigma = Points(0, 3);
  measured.spread.resize(model.cloud.positions.rows(), 0);
  measured.inner = inside.positions;
  measured.inner_displacement = inside.displacement;
  measured.inner_sigma = inside.sigma;
  EXPECT_TRUE(outliers(thinned_body(model, {}), model.conditions).empty());
  EXPECT_NE(test::refusal([&] { lessen_outliers(model, linear_options(), {}); }).find("on the cortex"),
            std::string::npos);
}

}  // namespace brainshift::solve::outliers_test
