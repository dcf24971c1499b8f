// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/nodal_displacement.hpp"

#include <gtest/gtest.h>

#include "solve/body/ordered_cloud.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::nodal_displacement_test {

TEST(NodalDisplacement, SumsShapeFunctionsInTheOrderOfTheCloud) {
  ShapeRows rows;
  const std::vector<std::int32_t> both = {0, 1}, second = {1};
  const std::vector<double> shares = {0.25, 0.75}, whole = {1};
  rows.append({both, shares, {}});
  rows.append({second, whole, {}});
  const NodalVectors parameters = {4, 8, 0, 99, 8, -8, 4, 99};  // the fourth of each is padding
  const Points u = nodal_displacement(rows, parameters, {1, 0});
  EXPECT_EQ(u.row(1), Eigen::RowVector3d(7, -4, 3));
  EXPECT_EQ(u.row(0), Eigen::RowVector3d(8, -8, 4));
}

/// The nodes are ordered for stepping; parameters H·X, ordered alike, are the displacement H·X of the cloud's own
/// nodes.
TEST(NodalDisplacement, OfALinearFieldIsTheField) {
  const NodeCloud cloud = test::irregular_box(5, 40);
  const OrderedCloud ordered = order_nodes(cloud, {});
  const Eigen::Matrix3d h = (Eigen::Matrix3d() << 0.1, 0.2, 0, -0.1, 0.3, 0.1, 0, 0.2, -0.1).finished();
  NodalVectors parameters(4 * cloud.size(), 0.0);
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    at(parameters, a).head<3>() = h * ordered.positions.row(static_cast<Eigen::Index>(a)).transpose();
  }
  const ShapeFunctions shape(ordered.positions, ordered.spacing, {});
  const Points u = nodal_displacement(shape.evaluate(ordered.positions, false), parameters, ordered.original);
  EXPECT_LE((u - cloud.positions * h.transpose()).cwiseAbs().maxCoeff(), 1e-11);
}

}  // namespace brainshift::solve::nodal_displacement_test
