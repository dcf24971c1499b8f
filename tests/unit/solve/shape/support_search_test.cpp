// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/support_search.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::support_search_test {

using test::irregular_box;
using test::random_points;

constexpr double side = 60;

TEST(SupportSearch, FindsWhatBruteForceFindsInAGradedCloud) {
  NodeCloud cloud = irregular_box(9, side);
  std::vector<double> radius;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    radius.push_back(2.0 + 38.0 * cloud.positions(a, 0) / side);  // 1 : 20
  }
  const SupportSearch search(cloud.positions, radius);
  std::vector<std::int32_t> found;
  const Points at = random_points(100, side);
  for (const auto& x : at.rowwise()) {
    search.find(x, 1.3, found);
    std::vector<std::int32_t> expected;
    for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
      if ((cloud.positions.row(a) - x).norm() < 1.3 * radius[static_cast<std::size_t>(a)]) {
        expected.push_back(static_cast<std::int32_t>(a));
      }
    }
    EXPECT_EQ(found, expected);
  }
}

}  // namespace brainshift::solve::support_search_test
