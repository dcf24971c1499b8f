// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/thinned_body.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::thinned_body_test {

/// So many that it takes two passes.
TEST(ThinnedBody, IsOfAtMostFiveHundredNodesOfTheCloudAndOfItsSize) {
  Model model = box_model(test::box_cells(8, model_side), 17);
  const ThinnedBody thinned = thinned_body(model, {});
  ASSERT_LE(thinned.node.size(), 500U);
  ASSERT_GT(thinned.node.size(), 50U);
  EXPECT_EQ(std::set(thinned.node.begin(), thinned.node.end()).size(), thinned.node.size());
  const Points places = model.cloud.positions(thinned.node, Eigen::all);
  EXPECT_EQ(thinned.stiff.cloud.positions, places);
  EXPECT_FALSE(thinned.stiff.touches);
  const Eigen::MatrixXd& k = thinned.stiff.stiffness;
  EXPECT_LT((k - k.transpose()).norm(), 1e-12 * k.norm());
  const Eigen::MatrixXd rigid = rigid_motions(places, places);
  EXPECT_LT((k * rigid).norm(), 1e-9 * k.norm() * rigid.norm()) << "a rigid motion costs nothing";
}

}  // namespace brainshift::solve::thinned_body_test
