// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/rigid_part.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::rigid_part_test {

TEST(RigidPart, IsAllOfARigidMotionAndNoneOfAStretch) {
  const Points places = test::irregular_box(5, 60).positions;
  const Eigen::RowVector3d middle = places.colwise().mean(), move(0.1, -0.2, 0.05), turn(0.001, 0.002, -0.003);
  const auto nodes = static_cast<std::size_t>(places.rows());
  NodalVectors from(4 * nodes, 1.0), to = from;
  double longest = 0;
  for (std::size_t a = 0; a < nodes; ++a) {
    const Eigen::Vector3d u = move + turn.cross(places.row(static_cast<Eigen::Index>(a)) - middle);
    at(to, a).head<3>() += u;
    longest = std::max(longest, u.norm());
  }
  const RigidPart part(places);
  EXPECT_NEAR(part.longest(to, from), longest, 1e-12);
  for (std::size_t a = 0; a < nodes; ++a) {  // a pure stretch on top: symmetric and about the middle
    const Eigen::RowVector3d x = places.row(static_cast<Eigen::Index>(a)) - middle;
    at(to, a)[0] += 0.01 * x.x();
  }
  EXPECT_NEAR(part.longest(to, from), longest, 0.1 * longest);
}

}  // namespace brainshift::solve::rigid_part_test
