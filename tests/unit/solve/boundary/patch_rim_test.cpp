// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/patch_rim.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::patch_rim_test {

constexpr int side_nodes = 9;
constexpr double side = 40, spacing = side / (side_nodes - 1);

/// A square of five by five nodes amid the top of a box.
struct Patch {
  NodeCloud cloud = test::irregular_box(side_nodes, side, 0.1);
  ShapeFunctions shape{cloud.positions, cloud.spacing, {}};
  Points prescribed = Points::Constant(cloud.positions.rows(), 3, std::nan(""));
  std::vector<std::int32_t> rim;  // ascending

  explicit Patch(int first = 2, int last = 6) {
    for (int j = first; j <= last; ++j) {
      for (int i = first; i <= last; ++i) {
        const int node = ((side_nodes - 1) * side_nodes + j) * side_nodes + i;
        prescribed.row(node) = linear(cloud.positions.row(node));
        if (i == first || i == last || j == first || j == last) {
          rim.push_back(node);
        }
      }
    }
  }

  static Eigen::RowVector3d linear(const Eigen::RowVector3d& x) {
    return {1 + 0.1 * x[0] - 0.2 * x[1], 0.3 * x[1], -2 + 0.05 * x[0]};
  }

  PatchRim found(std::vector<std::int32_t> fixed = {}) const {
    return patch_rim(cloud.positions, cloud.spacing, cloud.on_surface, prescribed, fixed, shape);
  }

  /// Where a row of shape functions was taken, as they reproduce linear fields.
  Eigen::RowVector3d place(const ShapeRow& row) const {
    Eigen::RowVector3d x = Eigen::RowVector3d::Zero();
    for (std::size_t k = 0; k < row.size(); ++k) {
      x += row.value[k] * cloud.positions.row(row.node[k]);
    }
    return x;
  }
};

TEST(PatchRim, IsTheOutermostNodesWhoseConditionsMoveInwards) {
  const Patch patch;
  const PatchRim rim = patch.found();
  ASSERT_EQ(rim.node, patch.rim);
  const Eigen::RowVector3d middle(side / 2, side / 2, side);
  for (std::size_t i = 0; i < rim.node.size(); ++i) {
    const Eigen::RowVector3d from = patch.cloud.positions.row(rim.node[i]), to = patch.place(rim.rows[i]);
    EXPECT_NEAR((to - from).norm(), rim_inset * spacing, 1e-6);
    EXPECT_LT((to - middle).norm(), (from - middle).norm() - 0.6 * rim_inset * spacing);
    EXPECT_NEAR(to.z(), side, 1e-6);
  }
}

TEST(PatchRim, KeepsALinearFieldExact) {
  const Patch patch;
  const PatchRim rim = patch.found();
  ASSERT_FALSE(rim.node.empty());
  for (std::size_t i = 0; i < rim.node.size(); ++i) {
    const Eigen::RowVector3d exact = Patch::linear(patch.place(rim.rows[i]));
    EXPECT_LE((rim.prescribed.row(static_cast<Eigen::Index>(i)) - exact).norm(), 1e-6);
  }
}

TEST(PatchRim, IsNoneWhereAPatchEndsWithItsFace) {
  EXPECT_TRUE(Patch(0, side_nodes - 1).found().node.empty());
}

TEST(PatchRim, IsNoneWhereNodesMaySlideOrNothingIsHeld) {
  Patch patch;
  patch.prescribed.col(0).setConstant(std::nan(""));
  EXPECT_TRUE(patch.found().node.empty());
  patch.prescribed.setConstant(std::nan(""));
  EXPECT_TRUE(patch.found().node.empty());
}

TEST(PatchRim, LeavesFixedNodesWhereTheyAre) {
  const Patch patch;
  const PatchRim rim = patch.found({patch.rim[3]});
  EXPECT_EQ(rim.node.size(), patch.rim.size() - 1);
  EXPECT_FALSE(std::binary_search(rim.node.begin(), rim.node.end(), patch.rim[3]));
}

TEST(PatchRim, PutsItsConditionsInPlaceOfTheNodes) {
  const Patch patch;
  const PatchRim rim = patch.found();
  const ShapeRows at_nodes = patch.shape.evaluate(patch.cloud.positions, false);
  const ShapeRows rows = rows_of_conditions(at_nodes, rim);
  const Points prescribed = prescribed_of_conditions(patch.prescribed, rim);
  ASSERT_EQ(rows.size(), at_nodes.size());
  const auto moved = static_cast<std::size_t>(rim.node[2]);
  EXPECT_LE((patch.place(rows[moved]) - patch.place(rim.rows[2])).norm(), 1e-12);
  EXPECT_EQ(prescribed.row(rim.node[2]), rim.prescribed.row(2));
  EXPECT_LE((patch.place(rows[0]) - patch.cloud.positions.row(0)).norm(), 1e-6);
}

}  // namespace brainshift::solve::patch_rim_test
