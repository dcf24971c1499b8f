// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/patch_rim.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solve/boundary/essential_conditions.hpp"
#include "solve/cut/cut_facets.hpp"
#include "solve/shape/shape_functions.hpp"
#include "solve/shape/visibility.hpp"
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
    PatchRim made = patch_rim(cloud, prescribed, fixed);
    made.rows = shape.evaluate(made.places, false);
    return made;
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

/// A sheet from below to above the top, along the patch's last nodes: past it they see no free ones.
TEST(PatchRim, IsNoneWhereAPatchEndsAtASheet) {
  const Patch patch;
  const double x = 6.5 * spacing;
  Cut sheet{"sheet", Points(4, 3), Triangles(2, 3), {}};
  sheet.vertices << x, -9, -9, x, side + 9, -9, x, side + 9, side + 9, x, -9, side + 9;
  sheet.triangles << 0, 1, 2, 0, 2, 3;
  const Visibility visibility(facets_between(std::span(&sheet, 1), from_the_start, 0));
  const auto beside = [&](std::int32_t node) { return std::abs(patch.cloud.positions(node, 0) - x) < spacing; };
  const PatchRim open = patch.found(), ended = patch_rim(patch.cloud, patch.prescribed, {}, &visibility);
  EXPECT_GE(std::ranges::count_if(open.node, beside), 3);
  EXPECT_LE(std::ranges::count_if(ended.node, beside), 2) << "at the corners alone";
  EXPECT_GE(ended.node.size() + 5, open.node.size());
}

TEST(PatchRim, IsTheOutermostNodesWhoseConditionsMoveInwards) {
  const Patch patch;
  const PatchRim rim = patch.found();
  ASSERT_EQ(rim.node, patch.rim);
  const Eigen::RowVector3d middle(side / 2, side / 2, side);
  for (std::size_t i = 0; i < rim.node.size(); ++i) {
    const Eigen::RowVector3d from = patch.cloud.positions.row(rim.node[i]), to = patch.place(rim.rows[i]);
    EXPECT_LE((to - from).norm(), rim_inset * spacing + 1e-6);
    EXPECT_GE((to - from).norm(), 0.8 * rim_inset * spacing);  // less where the next node is near
    EXPECT_LT((to - middle).norm(), (from - middle).norm() - 0.6 * rim_inset * spacing);
    EXPECT_NEAR(to.z(), side, 1e-6);
  }
}

TEST(PatchRim, OfANarrowPatchDoesNotMeetTheOppositeOne) {
  const Patch patch(4, 5);
  const PatchRim rim = patch.found();
  ASSERT_EQ(rim.node.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT((patch.place(rim.rows[i]) - patch.place(rim.rows[j])).norm(), 0.15 * spacing);
    }
  }
}

TEST(PatchRim, KeepsALinearFieldExact) {
  const Patch patch;
  const PatchRim rim = patch.found();
  ASSERT_FALSE(rim.node.empty());
  for (std::size_t i = 0; i < rim.node.size(); ++i) {
    Eigen::RowVector3d value = Eigen::RowVector3d::Zero();
    const ShapeRow extension = rim.extension[i];
    for (std::size_t k = 0; k < extension.size(); ++k) {
      value += extension.value[k] * patch.prescribed.row(extension.node[k]);
    }
    EXPECT_LE((value - Patch::linear(patch.place(rim.rows[i]))).norm(), 1e-6);
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

TEST(PatchRim, IsWhereItsNodesAreHeldInstead) {
  const Patch patch;
  const PatchRim rim = patch.found();
  const ShapeRows at_nodes = patch.shape.evaluate(patch.cloud.positions, false);
  std::vector<std::int32_t> names(patch.cloud.size());
  std::iota(names.begin(), names.end(), 0);
  EssentialConditions conditions(patch.prescribed, at_nodes, names, Imposition::exact, rim);
  conditions.factorise(std::vector<double>(patch.cloud.size(), 1.0));
  NodalVectors parameters(4 * patch.cloud.size(), 0.0);
  conditions.apply(1, parameters);
  const auto u = [&](const ShapeRow& row) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (std::size_t k = 0; k < row.size(); ++k) {
      sum += row.value[k] * at(parameters, static_cast<std::size_t>(row.node[k])).head<3>().transpose();
    }
    return sum;
  };
  for (std::size_t i = 0; i < rim.node.size(); ++i) {
    EXPECT_LE((u(rim.rows[i]) - Patch::linear(patch.place(rim.rows[i]))).norm(), 1e-6);
    EXPECT_GT((u(at_nodes[static_cast<std::size_t>(rim.node[i])]) - patch.prescribed.row(rim.node[i])).norm(), 1e-3);
  }
}

}  // namespace brainshift::solve::patch_rim_test
