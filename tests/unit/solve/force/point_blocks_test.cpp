// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/point_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "solve/quadrature/cell_points.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::point_blocks_test {

constexpr double side = 60;

/// Points of two materials and what the blocks are made from.
struct Parts {
  NodeCloud cloud = test::irregular_box(7, side);
  IntegrationPoints points = integration_points(test::box_cells(7, side), 8, nullptr, {1});
  ShapeRows rows = ShapeFunctions(cloud.positions, cloud.spacing, {}).evaluate(points.positions, true);
  std::vector<std::int32_t> material;
  PressurePatches patches;

  explicit Parts(double nodes_per_patch) {
    for (const auto& x : points.positions.rowwise()) {
      material.push_back(x[0] > side / 3 ? 1 : 0);
    }
    const std::vector<double> share(points.size(),
                                    static_cast<double>(cloud.size()) / static_cast<double>(points.size()));
    patches = pressure_patches(points.positions, share, material, nodes_per_patch);
  }
  PointBlocks blocks(Precision precision = Precision::double_precision) const {
    return point_blocks(points, rows, material, cloud.size(), patches, precision);
  }
};

/// Calls visit(point as ordered, its patch) for all.
template <class Visit>
void for_each_point(const PointBlocks& blocks, const Visit& visit) {
  for (const Patch& patch : blocks.patches) {
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      visit(p, patch);
    }
  }
}

template <class Scalar>
void expect_rows_of(const Parts& parts, const PointBlocks& blocks) {
  for_each_point(blocks, [&](std::int32_t p, const Patch& patch) {
    const auto point = static_cast<std::size_t>(parts.patches.order[static_cast<std::size_t>(p)]);
    const ShapeRow row = parts.rows[point];
    ASSERT_EQ(blocks.support_size(p), row.size());
    EXPECT_EQ(patch.material, parts.material[point]);
    EXPECT_EQ(blocks.volume[static_cast<std::size_t>(p)], parts.points.volume[point]);
    const auto slots = blocks.slots_of(p);
    const Scalar* derivative = blocks.template derivatives_of<Scalar>(p);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const auto slot = static_cast<std::size_t>(patch.first_slot + slots[k]);
      ASSERT_EQ(blocks.slot_node[slot], row.node[k]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(derivative[3 * k + axis], static_cast<Scalar>(row.derivative[3 * k + axis]));
      }
    }
  });
}

TEST(PointBlocks, HoldTheRowOfEveryPointInTheOrderOfThePatches) {
  const Parts parts(6);
  expect_rows_of<double>(parts, parts.blocks());
  const PointBlocks single = parts.blocks(Precision::single_precision);
  EXPECT_EQ(single.precision(), Precision::single_precision);
  EXPECT_TRUE(single.pair_derivative.empty());
  expect_rows_of<float>(parts, single);
}

TEST(PointBlocks, PadRowsToWholeQuadsWithZeros) {
  const Parts parts(6);
  const PointBlocks blocks = parts.blocks();
  for_each_point(blocks, [&](std::int32_t p, const Patch&) {
    const auto i = static_cast<std::size_t>(p);
    const auto length = static_cast<std::size_t>(blocks.pair_begin[i + 1] - blocks.pair_begin[i]);
    EXPECT_EQ(length % quad, 0U);
    EXPECT_LT(length - blocks.support_size(p), static_cast<std::size_t>(quad));
    const double* derivative = blocks.derivatives_of<double>(p);
    EXPECT_TRUE(
        std::all_of(derivative + 3 * blocks.support_size(p), derivative + 3 * length, [](double d) { return d == 0; }));
  });
}

TEST(PointBlocks, AreOfAboutAThousandPointsAndWholePatches) {
  const PointBlocks blocks = Parts(6).blocks();
  ASSERT_GE(blocks.blocks.size(), 3U) << "2744 points";
  std::int32_t next = 0;
  for (const Block& block : blocks.blocks) {
    EXPECT_EQ(block.first_patch, next);
    next = block.last_patch;
    const std::int32_t points = blocks.patches[static_cast<std::size_t>(block.last_patch) - 1].last_point -
                                blocks.patches[static_cast<std::size_t>(block.first_patch)].first_point;
    EXPECT_LE(points, 1024);
    const auto first = blocks.slot_node.begin() + block.first_slot;
    EXPECT_EQ(std::adjacent_find(first, first + block.slots, std::greater_equal<>()), first + block.slots)
        << "each node once";
  }
  EXPECT_EQ(next, static_cast<std::int32_t>(blocks.patches.size()));
}

TEST(PointBlocks, ListTheSlotsOfEachNode) {
  const PointBlocks blocks = Parts(6).blocks();
  std::vector<int> listed(blocks.slots(), 0);
  for (std::size_t a = 0; a < blocks.nodes(); ++a) {
    for (std::int64_t k = blocks.node_begin[a]; k < blocks.node_begin[a + 1]; ++k) {
      const auto slot = static_cast<std::size_t>(blocks.node_slot[static_cast<std::size_t>(k)]);
      EXPECT_EQ(blocks.slot_node[slot], static_cast<std::int32_t>(a));
      ++listed[slot];
    }
  }
  EXPECT_EQ(std::count(listed.begin(), listed.end(), 1), static_cast<std::ptrdiff_t>(listed.size()));
}

TEST(PointBlocks, HaveModesOnlyWherePointsShareAPressure) {
  const PointBlocks shared = Parts(6).blocks(), single = Parts(0).blocks();
  EXPECT_TRUE(single.mode.empty());
  EXPECT_EQ(single.patches.size(), single.points());
  EXPECT_NEAR(single.modes_of(9)[0] * single.modes_of(9)[0] * single.volume[9], 1, 1e-12);
  for (const Patch& patch : shared.patches) {
    Eigen::Matrix4d product = Eigen::Matrix4d::Zero();
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      product += shared.volume[static_cast<std::size_t>(p)] * shared.modes_of(p) * shared.modes_of(p).transpose();
    }
    EXPECT_NEAR(product(0, 0), 1, 1e-9);
    EXPECT_LE((product - Eigen::Matrix4d(product.diagonal().asDiagonal())).cwiseAbs().maxCoeff(), 1e-9);
  }
}

}  // namespace brainshift::solve::point_blocks_test
