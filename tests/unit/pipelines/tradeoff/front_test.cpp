// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/tradeoff/front.hpp"

#include <gtest/gtest.h>

namespace brainshift::pipelines::front_test {

TEST(Front, HoldsWhatIsNearerThanAllThatIsFaster) {
  const std::vector<CostAndError> points = {{3, 0.2}, {1, 0.5}, {2, 0.6}, {4, 0.1}, {1, 0.7}, {5, 0.3}};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1, 0, 3}));
}

TEST(Front, LeavesOutWhatIsNearerByLessThanAHundredth) {
  const std::vector<CostAndError> points = {{1, 0.5}, {2, 0.498}, {3, 0.4}};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{0, 2}));
  EXPECT_TRUE(pareto_front({}).empty());
}

}  // namespace brainshift::pipelines::front_test
