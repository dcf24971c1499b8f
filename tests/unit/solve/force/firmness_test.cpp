// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/firmness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solve/force/point_derivatives.hpp"
#include "solve/force/stiffness_bound.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve::firmness_test {

constexpr double side = 50;
constexpr int n = 7;
constexpr double contrast = 1000;

/// The end at large x is so many times as stiff.
Specimen two_tissues(double times) {
  return {test::irregular_box(n, side, 0.3, 4),
          test::box_cells(n - 1, side),
          {{.youngs_modulus = 3000, .poisson_ratio = 0.45}, {.youngs_modulus = times * 3000, .poisson_ratio = 0.49}},
          {}};
}

std::vector<double> bound_of(Specimen& body) {
  body.force(body.rest());
  return stiffness_bound(body.points, body.laws, body.scratch);
}

std::vector<double> firmness_of(Specimen& body) {
  body.points.felt = felt_tissues(body.points, body.laws.elastic.size());
  return node_firmness(body.points, shear_moduli(body.laws));
}

TEST(Firmness, IsTheRootOfTheShearModulusAwayFromOtherTissue) {
  Specimen body = two_tissues(contrast);
  const std::vector<double> firmness = firmness_of(body);
  const double soft = std::sqrt(shear_modulus({.youngs_modulus = 3000, .poisson_ratio = 0.45}));
  const double stiff = std::sqrt(shear_modulus({.youngs_modulus = 3000 * contrast, .poisson_ratio = 0.49}));
  for (std::size_t a = 0; a < firmness.size(); ++a) {
    const double x = body.cloud.positions(static_cast<Eigen::Index>(a), 0);
    EXPECT_GE(firmness[a], (1 - 1e-6) * soft);
    EXPECT_LE(firmness[a], (1 + 1e-6) * stiff);
    if (x < 1) {
      EXPECT_NEAR(firmness[a], soft, 1e-6 * soft);
    } else if (x > side - 1) {
      EXPECT_NEAR(firmness[a], stiff, 1e-6 * stiff);
    }
  }
}

TEST(Firmness, IsNoneOfOneTissue) {
  Specimen body(test::irregular_box(n, side, 0.3, 4), test::box_cells(n - 1, side), {{}}, {});
  EXPECT_TRUE(firmness_of(body).empty());
}

TEST(NodeShares, AreBoundedAndAddUpToTwiceAtMost) {
  Specimen body = two_tissues(contrast);
  const std::vector<double> firmness = firmness_of(body);
  for (const Block& block : body.points.blocks) {
    NodeShares shares(body.points, block, firmness);
    for (std::int32_t p = body.points.patches[static_cast<std::size_t>(block.first_patch)].first_point;
         p < body.points.patches[static_cast<std::size_t>(block.last_patch - 1)].last_point; ++p) {
      const std::vector<double> reach = column_norms(derivatives(body.points, p));
      const std::span<const double> share = shares.of(body.points.slots_of(p), reach);
      double over = 0;
      for (std::size_t a = 0; a < share.size(); ++a) {
        EXPECT_GT(share[a], 0);
        EXPECT_LE(share[a], 1);
        over += reach[a] / share[a];
      }
      EXPECT_LE(over, (2 + 1e-12) * std::accumulate(reach.begin(), reach.end(), 0.0));
    }
  }
}

TEST(NodeShares, LightenNodesOfSoftTissueBesideStiffAndOthersHardlyGrowByMoreThanTwice) {
  Specimen body = two_tissues(contrast);
  const std::vector<double> even = bound_of(body);
  ASSERT_FALSE(firmness_of(body).empty());
  const std::vector<double> shared = bound_of(body);
  double least = 1, most = 0;
  for (std::size_t a = 0; a < even.size(); ++a) {
    least = std::min(least, shared[a] / even[a]);
    most = std::max(most, shared[a] / even[a]);
  }
  RecordProperty("least", std::to_string(least));
  RecordProperty("most", std::to_string(most));
  EXPECT_LT(least, 0.5);
  EXPECT_LE(most, 2);
}

}  // namespace brainshift::solve::firmness_test
