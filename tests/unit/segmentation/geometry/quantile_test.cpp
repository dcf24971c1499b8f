// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/quantile.hpp"

#include <gtest/gtest.h>

namespace brainshift::quantile_test {

TEST(Quantile, IsWhatAShareOfTheValuesLiesBelow) {
  std::vector<double> values;
  for (int i = 0; i < 100; ++i) {
    values.push_back((i * 37) % 100);
  }
  EXPECT_EQ(quantile(values, 0.95), 95);
  EXPECT_EQ(median(values), 50);
  EXPECT_EQ(quantile(std::vector<double>{3}, 0.95), 3);
}

}  // namespace brainshift::quantile_test
