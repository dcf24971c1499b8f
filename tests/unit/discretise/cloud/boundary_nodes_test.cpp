// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/boundary_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "discretise/cloud/make_cloud.hpp"
#include "discretise/discretise.hpp"
#include "discretise/sizing/tissue_lookup.hpp"
#include "tests/unit/discretise/bodies.hpp"

namespace brainshift::discretise::boundary_nodes_test {

const Eigen::Vector3d centre(30, -210, 55);
constexpr double inner = 20, outer = 40;
constexpr double rounded = 0.55;  // of a voxel: by which the smooth boundary may be off

const LabelMap& labels() {
  static const LabelMap made = test::ball_labels(centre, inner, outer);
  return made;
}

double off_the_boundary(const Eigen::RowVector3d& x) {
  return std::abs((x.transpose() - centre).norm() - inner);
}

/// Mean and largest distance from the boundary.
std::pair<double, double> mean_and_largest(const Points& places) {
  double sum = 0, largest = 0;
  for (const auto& place : places.rowwise()) {
    sum += off_the_boundary(place);
    largest = std::max(largest, off_the_boundary(place));
  }
  return {sum / static_cast<double>(places.rows()), largest};
}

TEST(BoundaryNodes, TakeTheStepsOutOfTheVoxels) {
  const double steps = mean_and_largest(tissue_boundary(labels(), std::array{1, 3})).first;
  const auto [mean, largest] = mean_and_largest(smooth_tissue_boundary(&labels(), {}));
  EXPECT_LT(mean, 0.6 * steps);
  EXPECT_LT(largest, rounded);
}

TEST(BoundaryNodes, AreNoneWhereTissuesAreAlikeOrUnknown) {
  EXPECT_EQ(smooth_tissue_boundary(&labels(), {.alike = {{1, 3}}}).rows(), 0);
  EXPECT_EQ(smooth_tissue_boundary(nullptr, {}).rows(), 0);
}

TEST(BoundaryNodes, LieOnTheBoundaryApartFromEachOtherAndNoneBesideIt) {
  const Surface surface = test::ball(outer, centre, 4);
  const Discretisation made = discretise(surface, &labels(), {.nodes = 3000});
  const NodeCloud& cloud = made.cloud;
  std::size_t on_it = 0, beside = 0;
  for (std::size_t node = 0; node < cloud.size(); ++node) {
    const double off = off_the_boundary(cloud.positions.row(static_cast<Eigen::Index>(node)));
    on_it += off < rounded ? 1 : 0;
    beside += off >= rounded && off < 0.3 * made.measures.spacing ? 1 : 0;
  }
  EXPECT_EQ(on_it, made.measures.boundary_nodes);
  EXPECT_EQ(beside, 0U);
  const double area = 4 * std::acos(-1.0) * inner * inner, spacing = made.measures.spacing;
  EXPECT_GT(static_cast<double>(on_it), 0.6 * area / (spacing * spacing));
  EXPECT_GE(made.measures.smallest_distance_ratio, 0.5);
  EXPECT_NEAR(static_cast<double>(cloud.size()), 3000, 150);
}

TEST(BoundaryNodes, StayInTheBodyAndOffTheNodesThatAreFixed) {
  const Surface surface = test::ball(10, centre, 3);
  const Scanlines body(surface);
  Points boundary(2, 3), fixed(1, 3), nodes(3, 3);
  boundary << centre.transpose() + Eigen::RowVector3d(11, 0, 0), centre.transpose();
  fixed.row(0) = centre.transpose() + Eigen::RowVector3d(0, 1, 0);
  nodes.row(0) = centre.transpose() + Eigen::RowVector3d(9.5, 0, 0);  // its place is outside
  nodes.row(1) = centre.transpose() + Eigen::RowVector3d(0, -1, 0);   // its place is beside a fixed node
  nodes.row(2) = centre.transpose() + Eigen::RowVector3d(0, -5, 0);   // far from it
  const Points before = nodes;
  EXPECT_EQ(move_onto_boundary(boundary, fixed, body, SizingField(), 4, nodes), 0U);
  ASSERT_EQ(nodes.rows(), 2);
  EXPECT_EQ(nodes.row(0), before.row(0));
  EXPECT_EQ(nodes.row(1), before.row(2));
}

}  // namespace brainshift::discretise::boundary_nodes_test
