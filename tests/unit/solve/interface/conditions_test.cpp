// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/interface/conditions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::conditions_test {

using Nodes = std::vector<std::int32_t>;

const NodeCloud cloud = test::irregular_box(3, 10);

/// Node 4 is moved, component y of node 7 is held, node 9 is pushed, node 4 too.
Conditions some() {
  Conditions conditions = test::all_free(cloud);
  conditions.displacement.row(4) << 1, -2, 3;
  conditions.displacement(7, 1) = 0;
  conditions.force = Points::Zero(27, 3);
  conditions.force(4, 2) = 0.5;
  conditions.force(9, 0) = -1;
  return conditions;
}

TEST(Conditions, SayWhatIsPrescribedWhere) {
  const Conditions conditions = some();
  EXPECT_TRUE(conditions.is_prescribed(7)) << "held at 0 is prescribed";
  EXPECT_TRUE(conditions.is_prescribed(7, 1));
  EXPECT_FALSE(conditions.is_prescribed(7, 0));
  EXPECT_FALSE(conditions.is_prescribed(9));
  EXPECT_TRUE(conditions.is_held(4));
  EXPECT_FALSE(conditions.is_held(7)) << "it slides";
  EXPECT_TRUE(conditions.is_pushed(9));
  EXPECT_FALSE(conditions.is_pushed(7));
  EXPECT_EQ(prescribed_nodes(conditions), (Nodes{4, 7}));
  EXPECT_EQ(count_loaded(conditions), 3U) << "node 4 once";
}

TEST(Conditions, OfNoRowsPrescribeNothing) {
  const Conditions none;
  EXPECT_FALSE(none.is_prescribed(3));
  EXPECT_FALSE(none.is_prescribed(3, 1));
  EXPECT_FALSE(none.is_held(3));
  EXPECT_FALSE(none.is_pushed(3));
  EXPECT_TRUE(prescribed_nodes(none).empty());
  EXPECT_EQ(count_loaded(none), 0U);
  Conditions forces;
  forces.force = some().force;
  EXPECT_EQ(count_loaded(forces), 2U) << "forces without displacements";
}

TEST(Conditions, OfSomeNodesAreInTheirOrder) {
  const Conditions part = subset(some(), {9, 4, 0});
  EXPECT_EQ(prescribed_nodes(part), Nodes{1});
  EXPECT_EQ(part.displacement.row(1), Eigen::RowVector3d(1, -2, 3));
  EXPECT_EQ(part.force.row(0), Eigen::RowVector3d(-1, 0, 0));
  EXPECT_EQ(subset(Conditions(), {9, 4, 0}).displacement.rows(), 0);
}

TEST(Conditions, SurviveWritingAndReading) {
  const test::ScratchFolder folder;
  const Conditions written = some();
  write_nodes(folder / "nodes.vtu", cloud, written);
  const Conditions read = read_conditions(folder / "nodes.vtu");
  EXPECT_EQ(read.force, written.force);
  EXPECT_EQ(prescribed_nodes(read), prescribed_nodes(written));
  EXPECT_EQ(read.displacement.row(4), written.displacement.row(4));
  EXPECT_TRUE(std::isnan(read.displacement(7, 0)));
  EXPECT_EQ(read_node_cloud(folder / "nodes.vtu").positions, cloud.positions);
}

TEST(Conditions, OfAFileWithoutTheirArraysAreNone) {
  const test::ScratchFolder folder;
  write_nodes(folder / "nodes.vtu", cloud, {});
  const Conditions read = read_conditions(folder / "nodes.vtu");
  EXPECT_EQ(read.displacement.rows() + read.force.rows(), 0);
}

TEST(Conditions, ThatAreNotFiniteAreRefusedWithFileAndNode) {
  const test::ScratchFolder folder;
  const auto fault = [&](const Conditions& conditions) {
    write_nodes(folder / "nodes.vtu", cloud, conditions);
    return test::refusal([&] { read_conditions(folder / "nodes.vtu"); });
  };
  EXPECT_EQ(fault(some()), "");
  for (const double bad : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    Conditions moved = some(), pushed = some();
    moved.displacement(5, 2) = bad;
    pushed.force(6, 1) = bad;
    if (std::isinf(bad)) {
      EXPECT_NE(fault(moved).find("nodes.vtu"), std::string::npos);
      EXPECT_NE(fault(moved).find("node 5 is infinite"), std::string::npos) << fault(moved);
    } else {
      EXPECT_EQ(fault(moved), "") << "free";
    }
    EXPECT_NE(fault(pushed).find("force on node 6 is not finite"), std::string::npos) << fault(pushed);
  }
}

}  // namespace brainshift::solve::conditions_test
