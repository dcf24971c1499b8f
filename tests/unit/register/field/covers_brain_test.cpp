// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/covers_brain.hpp"

#include <gtest/gtest.h>

#include "tests/unit/register/builders.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::covers_brain_test {

using namespace builders;

RegisterInput still() {
  return head([](const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); });
}

std::string fault_of(const RegisterInput& input) {
  const Surface* const wall = input.cavity ? &input.cavity->wall : nullptr;
  return test::refusal([&] { check_covers(input, brain_zones(input.brain, input.t1.geometry, 15, wall)); });
}

TEST(CoversBrain, TakesNodesThatFillIt) {
  EXPECT_EQ(fault_of(still()), "");
}

TEST(CoversBrain, RefusesNodesOfAnotherPlaceOrFrame) {
  RegisterInput input = still();
  input.solution.positions.col(0).array() += 20;
  EXPECT_NE(fault_of(input).find("from every node"), std::string::npos);
  input = still();
  input.solution.positions.leftCols(2) *= -1;
  EXPECT_NE(fault_of(input).find("not of this brain"), std::string::npos);
}

TEST(CoversBrain, RefusesABrainOfWhichHalfHasNoNodes) {
  RegisterInput input = still();
  input.solution = at_nodes(input.solution, [](const Eigen::Vector3d& x) { return x.x() < centre.x(); });
  EXPECT_NE(fault_of(input).find("from every node"), std::string::npos);
}

TEST(CoversBrain, TakesABrainWithACavityWhetherItsWallIsKnownOrNot) {
  RegisterInput input = still();
  input.solution =
      at_nodes(input.solution, [](const Eigen::Vector3d& x) { return (x - centre).norm() > 0.7 * radius; });
  EXPECT_EQ(fault_of(input), "") << "a third of the brain";
  input = still();
  const Eigen::Vector3d side = centre + Eigen::Vector3d(radius, 0, 0);
  input.solution = at_nodes(input.solution, [&](const Eigen::Vector3d& x) { return (x - side).norm() > radius; });
  input.cavity = Cavity{ball(side, radius), {3}};
  EXPECT_EQ(fault_of(input), "") << "a quarter of its surface";
}

TEST(CoversBrain, RefusesNodesFarOutside) {
  RegisterInput input = still();
  Solution& large = input.solution;
  const Eigen::Index nodes = large.positions.rows();
  large.positions.conservativeResize(2 * nodes, 3);
  large.positions.bottomRows(nodes) = large.positions.topRows(nodes).array() * 3;
  large.spacing.insert(large.spacing.end(), large.spacing.begin(), large.spacing.end());
  EXPECT_NE(fault_of(input).find("outside it"), std::string::npos);
}

}  // namespace brainshift::registration::covers_brain_test
