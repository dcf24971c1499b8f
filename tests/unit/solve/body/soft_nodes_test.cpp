// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/soft_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solve/shape/shape_functions.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::soft_nodes_test {

constexpr double side = model_side, wall = side / 2, stiff = 1000, soft = 3;
constexpr int n = 7;

/// Nodes of a cube, its middle layer on the plane between stiff tissue below and soft tissue above.
NodeCloud cloud_with_a_wall() {
  NodeCloud cloud = test::irregular_box(n, side);
  for (auto x : cloud.positions.rowwise()) {
    x[2] = std::abs(x[2] - wall) < 0.3 * cloud.spacing[0] ? wall : x[2];
  }
  return cloud;
}

/// Points that fill the cube evenly, µ by the side of the wall on which they lie, and what sees them.
struct Filled {
  NodeCloud cloud = cloud_with_a_wall();
  ShapeOptions options;
  Points places{18 * 18 * 18, 3};
  std::vector<double> volume, modulus;
  ShapeRows rows;
  std::vector<double> moved_with;

  explicit Filled(double upper = soft) {
    const double step = side / 18;
    for (Eigen::Index p = 0; p < places.rows(); ++p) {
      places.row(p) << step * (static_cast<double>(p % 18) + 0.5), step * (static_cast<double>(p / 18 % 18) + 0.5),
          step * (static_cast<double>(p / 324) + 0.5);
      volume.push_back(step * step * step);
      modulus.push_back(places(p, 2) < wall ? stiff : upper);
    }
    rows = ShapeFunctions(cloud.positions, cloud.spacing, options).evaluate(places, true);
    moved_with = moduli_at_nodes(volume, modulus, rows, cloud.size());
  }

  MixedCloud mixed() const { return {cloud.positions, cloud.spacing, options, nullptr, moved_with}; }
};

TEST(SoftNodes, MoveWithTheirTissueAndOnTheWallWithTheStiffOne) {
  const Filled filled;
  for (std::size_t a = 0; a < filled.cloud.size(); ++a) {
    const double z = filled.cloud.positions(static_cast<Eigen::Index>(a), 2);
    EXPECT_EQ(filled.moved_with[a], z > wall ? soft : stiff) << z;
  }
}

TEST(SoftNodes, OfNoPointAreHiddenFromNone) {
  const std::vector<double> modulus = moduli_at_nodes({}, {}, ShapeRows(), 2);
  ASSERT_EQ(modulus.size(), 2U);
  EXPECT_EQ(modulus[1], std::numeric_limits<double>::infinity());
}

TEST(SoftNodes, AreHiddenFromStiffTissueAlone) {
  Filled filled;
  const ShapeRows before = filled.rows;
  EXPECT_GT(hide_soft_nodes(filled.mixed(), filled.places, filled.modulus, filled.rows), 0U);
  for (std::size_t p = 0; p < filled.rows.size(); ++p) {
    const double z = filled.places(static_cast<Eigen::Index>(p), 2);
    if (z < wall) {
      for (const std::int32_t a : filled.rows[p].node) {
        EXPECT_LE(filled.cloud.positions(a, 2), wall);
      }
    }
    if (z > wall || z < wall - 2.2 * filled.cloud.spacing[0]) {
      EXPECT_TRUE(std::ranges::equal(filled.rows[p].derivative, before[p].derivative)) << z;
    }
  }
}

/// A field that is linear on each side of the wall and bends there: exact on the stiff side, gradients too, and not
/// with all nodes seen.
TEST(SoftNodes, LeaveTheStiffSideItsOwnStrain) {
  Filled filled;
  const auto field = [](double x, double z) { return 0.2 * x + (z < wall ? 0.1 : 3.0) * (z - wall); };
  const auto error = [&] {
    double largest = 0;
    for (std::size_t p = 0; p < filled.rows.size(); ++p) {
      if (filled.modulus[p] == stiff) {
        const ShapeRow row = filled.rows[p];
        Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
        for (std::size_t k = 0; k < row.size(); ++k) {
          const Eigen::RowVector3d node = filled.cloud.positions.row(row.node[k]);
          gradient += row.gradient(k) * field(node[0], node[2]);
        }
        largest = std::max(largest, (gradient - Eigen::Vector3d(0.2, 0, 0.1)).norm());
      }
    }
    return largest;
  };
  EXPECT_GT(error(), 0.3);
  hide_soft_nodes(filled.mixed(), filled.places, filled.modulus, filled.rows);
  EXPECT_LT(error(), 1e-8);
}

TEST(SoftNodes, AreNotHiddenWhereStiffnessChangesLittle) {
  Filled filled(stiff / 2.9);
  EXPECT_EQ(hide_soft_nodes(filled.mixed(), filled.places, filled.modulus, filled.rows), 0U);
}

/// A stiff sheet of two fifths of a spacing about the middle layer of nodes, whose creases rise by so many spacings.
Filled with_a_sheet(double rise) {
  Filled filled;
  const double h = filled.cloud.spacing[0];
  const auto sheet = [&](double x) { return wall + rise * h * std::sin(2 * x / h); };
  for (auto x : filled.cloud.positions.rowwise()) {
    x[2] = x[2] == wall ? sheet(x[0]) : x[2];
  }
  for (std::size_t p = 0; p < filled.modulus.size(); ++p) {
    const Eigen::RowVector3d x = filled.places.row(static_cast<Eigen::Index>(p));
    filled.modulus[p] = std::abs(x[2] - sheet(x[0])) < h / 5 ? stiff : soft;
  }
  filled.rows =
      ShapeFunctions(filled.cloud.positions, filled.cloud.spacing, filled.options).evaluate(filled.places, true);
  filled.moved_with = moduli_at_nodes(filled.volume, filled.modulus, filled.rows, filled.cloud.size());
  return filled;
}

TEST(SoftNodes, AreSeenByASheetWhoseNodesLieInAPlane) {
  Filled filled = with_a_sheet(0);
  const ShapeRows before = filled.rows;
  hide_soft_nodes(filled.mixed(), filled.places, filled.modulus, filled.rows);
  for (std::size_t p = 0; p < filled.rows.size(); ++p) {
    if (filled.modulus[p] == stiff) {
      EXPECT_TRUE(std::ranges::equal(filled.rows[p].node, before[p].node));
    }
  }
}

/// As the septum between a brain's ventricles, which else moves single nodes of the fluid at will.
TEST(SoftNodes, AreHiddenFromACreasedSheetOfOneLayerOfNodes) {
  Filled filled = with_a_sheet(0.4);
  EXPECT_GT(hide_soft_nodes(filled.mixed(), filled.places, filled.modulus, filled.rows), 0U);
  std::size_t hides = 0, all = 0;
  for (std::size_t p = 0; p < filled.rows.size(); ++p) {
    if (filled.modulus[p] == stiff) {
      const ShapeRow row = filled.rows[p];
      Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
      for (std::size_t k = 0; k < row.size(); ++k) {
        gradient += row.gradient(k) * filled.cloud.positions.row(row.node[k]);
      }
      EXPECT_LT((gradient - Eigen::Matrix3d::Identity()).norm(), 1e-8);
      const auto is_stiff = [&](std::int32_t a) { return filled.moved_with[static_cast<std::size_t>(a)] == stiff; };
      hides += std::ranges::all_of(row.node, is_stiff) ? 1 : 0;
      ++all;
    }
  }
  EXPECT_EQ(hides, all);
}

TEST(SoftNodes, AreSeenWhereTooFewOthersAreLeft) {
  Filled filled;
  std::ranges::fill(filled.moved_with, soft);
  std::ranges::fill_n(filled.moved_with.begin(), 3, stiff);
  EXPECT_EQ(hide_soft_nodes(filled.mixed(), filled.places, filled.modulus, filled.rows), 0U);
}

}  // namespace brainshift::solve::soft_nodes_test
