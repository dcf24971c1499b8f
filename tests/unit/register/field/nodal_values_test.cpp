// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/nodal_values.hpp"

#include <gtest/gtest.h>

namespace brainshift::registration::nodal_values_test {

TEST(NodalValues, AreKnownAsFarFromANodeAsItsOwnSpacing) {
  constexpr double unknown = -1;
  Solution solution;
  solution.positions = Points{{0, 0, 0}, {100, 0, 0}};
  solution.displacement = Points::Zero(2, 3);
  solution.spacing = {1, 10};
  const Points places{{5, 0, 0}, {105, 0, 0}};
  const Eigen::VectorXd values = nodal_values_at(solution, Eigen::Vector2d(1, 2), false, places, unknown);
  EXPECT_EQ(values[0], unknown);
  EXPECT_NEAR(values[1], 2, 0.01);
}

}  // namespace brainshift::registration::nodal_values_test
