// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/outliers.hpp"

#include <gtest/gtest.h>

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

}  // namespace brainshift::solve::outliers_test
