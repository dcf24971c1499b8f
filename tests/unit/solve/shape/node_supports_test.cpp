// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/node_supports.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::node_supports_test {

TEST(NodeSupports, DilatationIsThatGivenElseTheDefaultOfTheBasis) {
  EXPECT_EQ(dilatation({.basis = Basis::linear, .dilatation = 3.1}), 3.1);
  EXPECT_EQ(dilatation({.basis = Basis::linear}), 1.6);
  EXPECT_EQ(dilatation({.basis = Basis::quadratic}), 2.2);
  EXPECT_EQ(dilatation({.basis = Basis::modified_quadratic}), 2.2);
  EXPECT_EQ(dilatation({.basis = Basis::linear, .planar = true}), 1.8);
  EXPECT_EQ(dilatation({.basis = Basis::modified_quadratic, .planar = true}), 2.4);
}

TEST(NodeSupports, RadiusGrowsWithTheSpacingOfEachNode) {
  const std::vector<double> spacing = {1, 4, 2.5};
  EXPECT_EQ(support_radii(spacing, {.dilatation = 2}), (std::vector<double>{2, 8, 5}));
}

/// The numbers of nodes that ShapeOptions::dilatation names for the planar defaults, in the middle of an even cloud.
TEST(NodeSupports, OfThePlanarDefaultsHoldAsManyNodesAsStated) {
  const NodeCloud cloud = test::irregular_rectangle(21, 21, 20, 20, 0.2);
  const auto mean_count = [&](Basis basis) {
    const NodeSupports supports(cloud.positions, cloud.spacing, {.basis = basis, .planar = true}, nullptr);
    double sum = 0;
    const Points at = test::random_points(200, 10);
    std::vector<std::int32_t> found;
    for (Eigen::Index i = 0; i < at.rows(); ++i) {
      supports.search.find(Eigen::Vector3d(at(i, 0) + 5, at(i, 1) + 5, 0), 1, found, 0);
      sum += static_cast<double>(found.size());
    }
    return sum / static_cast<double>(at.rows());
  };
  EXPECT_NEAR(mean_count(Basis::linear), 11, 2);
  EXPECT_NEAR(mean_count(Basis::modified_quadratic), 19, 2.5);
}

}  // namespace brainshift::solve::node_supports_test
