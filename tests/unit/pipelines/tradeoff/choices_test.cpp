// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/tradeoff/choices.hpp"

#include <gtest/gtest.h>

namespace brainshift::pipelines::choices_test {

TEST(Choices, AreAllCombinationsWithTheCloudsOneAfterTheOther) {
  TradeoffLists lists;
  lists.nodes = "100, 200";
  lists.points_per_cell = "auto";
  lists.basis = "linear";
  lists.derivatives = "full";
  lists.precision = "double single";
  lists.tolerance = "0.1 0.01";
  const std::vector<Choice> choices = all_choices(lists);
  ASSERT_EQ(choices.size(), 8);
  EXPECT_EQ(name_of(choices[0]), "100-auto-0-linear-full-double-0.1");
  EXPECT_EQ(name_of(choices[3]), "100-auto-0-linear-full-single-0.01");
  EXPECT_EQ(choices[4][0], "200");
  EXPECT_EQ(reference_choice(lists).back(), "0.001");
}

}  // namespace brainshift::pipelines::choices_test
