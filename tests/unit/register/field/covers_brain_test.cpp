// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/covers_brain.hpp"

#include <gtest/gtest.h>

#include "tests/unit/register/builders.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::covers_brain_test {

using namespace builders;

std::string fault_of(const Solution& solution) {
  const ImageGeometry geometry = grid();
  const BrainZones zones = brain_zones(ball(centre, radius), geometry, 15);
  return test::refusal([&] { check_covers(solution, zones, geometry); });
}

Solution still() {
  return solution([](const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); });
}

TEST(CoversBrain, TakesNodesThatFillIt) {
  EXPECT_EQ(fault_of(still()), "");
}

TEST(CoversBrain, RefusesNodesOfAnotherPlaceOrFrame) {
  Solution aside = still();
  aside.positions.col(0).array() += 20;
  EXPECT_NE(fault_of(aside).find("from every node"), std::string::npos);
  Solution in_ras = still();
  in_ras.positions.leftCols(2) *= -1;
  EXPECT_NE(fault_of(in_ras).find("not of this brain"), std::string::npos);
}

TEST(CoversBrain, RefusesABrainOfWhichAPartHasNoNodes) {
  Solution half = still();
  std::vector<Eigen::Index> left;
  for (Eigen::Index a = 0; a < half.positions.rows(); ++a) {
    if (half.positions(a, 0) < centre.x()) {
      left.push_back(a);
    }
  }
  half.positions = Points(half.positions(left, Eigen::all));
  half.spacing.resize(left.size());
  EXPECT_NE(fault_of(half).find("from every node"), std::string::npos);
}

TEST(CoversBrain, RefusesNodesFarOutside) {
  Solution large = still();
  const Eigen::Index nodes = large.positions.rows();
  large.positions.conservativeResize(2 * nodes, 3);
  large.positions.bottomRows(nodes) = large.positions.topRows(nodes).array() * 3;
  large.spacing.insert(large.spacing.end(), large.spacing.begin(), large.spacing.end());
  EXPECT_NE(fault_of(large).find("outside it"), std::string::npos);
}

}  // namespace brainshift::registration::covers_brain_test
