// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/coarse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solve/body/ordered_cloud.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/pressed_bar.hpp"

namespace brainshift::solve::coarse_test {

TEST(CoarseNodes, AreAnEvenEighth) {
  const NodeCloud cloud = test::irregular_box(21, 100);
  const std::vector<std::int32_t> nodes = coarse_nodes(cloud, {});
  EXPECT_GT(nodes.size(), cloud.size() / 12);
  EXPECT_LT(nodes.size(), cloud.size() / 4);
  const NodeCloud coarse = subset(cloud, nodes);
  for (Eigen::Index a = 0; a < coarse.positions.rows(); ++a) {
    for (Eigen::Index b = 0; b < a; ++b) {
      EXPECT_GT((coarse.positions.row(a) - coarse.positions.row(b)).norm(), 1.4 * 5);
    }
  }
}

TEST(CoarseNodes, HoldTheLoadedOnesFirst) {
  const NodeCloud cloud = test::irregular_box(11, 100);
  Conditions conditions = test::all_free(cloud);
  const std::int32_t loaded = 5 * 121 + 5 * 11 + 4;  // beside the inner node that is chosen else
  conditions.displacement.row(loaded).setConstant(1);
  const std::vector<std::int32_t> nodes = coarse_nodes(cloud, conditions);
  EXPECT_TRUE(std::ranges::binary_search(nodes, loaded));
  EXPECT_TRUE(std::ranges::is_sorted(nodes));
}

TEST(CoarseBody, TakesAllForcesWithTheirMoments) {
  Model model = uniaxial(1, 7);
  const Points& x = model.cloud.positions;
  model.conditions.force = (x.array() * x.array().rowwise().sum().sin().replicate(1, 3)).matrix();
  const NodeCloud coarse = subset(model.cloud, coarse_nodes(model.cloud, model.conditions));
  const Points on_coarse =
      coarse_body(coarse_nodes(model.cloud, model.conditions), model, {}, {}).model.conditions.force;
  ASSERT_EQ(on_coarse.rows(), coarse.positions.rows());
  const Points& force = model.conditions.force;
  EXPECT_LE((on_coarse.colwise().sum() - force.colwise().sum()).norm(), 1e-9 * force.norm());
  const Eigen::Matrix3d moments = coarse.positions.transpose() * on_coarse;
  EXPECT_LE((moments - x.transpose() * force).norm(), 1e-9 * force.norm() * model_side);
}

TEST(CoarseDisplacement, IsNearTheSolutionAndAsPrescribedWhereItIs) {
  const Model model = uniaxial(1.1, 11);
  const auto coarse = coarse_displacement(model, {}, {});
  ASSERT_TRUE(coarse);
  const Points& prescribed = model.conditions.displacement;
  ASSERT_EQ(coarse->rows(), prescribed.rows());
  for (Eigen::Index a = 0; a < prescribed.rows(); ++a) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isnan(prescribed(a, axis))) {
        EXPECT_EQ((*coarse)(a, axis), prescribed(a, axis));
      }
    }
  }
  const double lateral = uniaxial_answer(model.materials.at(1), 1.1).second;
  const Eigen::RowVector3d strain(lateral - 1, lateral - 1, 0.1);
  const Points exact = model.cloud.positions.array().rowwise() * strain.array();
  EXPECT_LT((*coarse - exact).rowwise().norm().maxCoeff(), 1.5) << "of 6 mm";
}

TEST(CoarseDisplacement, IsAsPrescribedAtTheEndOfTheCurve) {
  Model model = uniaxial(1.1, 11);
  model.curve = LoadCurve({0, 0.05}, {0, 0.7}, LoadCurve::Join::smooth);
  const auto coarse = coarse_displacement(model, {}, {});
  ASSERT_TRUE(coarse);
  for (Eigen::Index a = 0; a < coarse->rows(); ++a) {
    const double prescribed = model.conditions.displacement(a, 2);
    EXPECT_TRUE(std::isnan(prescribed) || (*coarse)(a, 2) == 0.7 * prescribed) << a;
  }
}

TEST(CoarseDisplacement, IsNoneWhereTheCoarseCloudCannotBeSolved) {
  EXPECT_FALSE(coarse_displacement(uniaxial(1.1, 3), {}, {})) << "too few nodes";
  Model unheld = pressed_bar();
  unheld.conditions = test::all_free(unheld.cloud);
  EXPECT_FALSE(coarse_displacement(unheld, {}, {}));
}

}  // namespace brainshift::solve::coarse_test
