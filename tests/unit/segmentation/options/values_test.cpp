// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/options/values.hpp"

#include <gtest/gtest.h>

namespace brainshift::values_test {

TEST(Values, ARangeHoldsItsEndsWhereTheyAreAllowed) {
  const Range open{.low = -1, .high = 0.5, .low_allowed = false, .high_allowed = false};
  EXPECT_FALSE(open.holds(-1));
  EXPECT_FALSE(open.holds(0.5));
  EXPECT_TRUE(open.holds(0.499));
  const Range closed{.low = 30, .high = 2e7};
  EXPECT_TRUE(closed.holds(30));
  EXPECT_TRUE(closed.holds(2e7));
  EXPECT_FALSE(closed.holds(29));
  EXPECT_FALSE(any_number.holds(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(any_number.holds(std::numeric_limits<double>::infinity()));
}

TEST(Values, ARangeReadsAsASentence) {
  EXPECT_EQ(allowed_numbers("a whole number", {.low = 30, .high = 2e7}), "a whole number from 30 to 20000000");
  EXPECT_EQ(allowed_numbers("a number", {.low = 1e-6, .high = 1e6}), "a number from 1e-06 to 1000000");
  EXPECT_EQ(allowed_numbers("a number", above_zero), "a number > 0");
  EXPECT_EQ(allowed_numbers("a number", {.low = -1, .high = 0.5, .low_allowed = false, .high_allowed = false}),
            "a number > -1 and < 0.5");
  EXPECT_EQ(allowed_numbers("a number", any_number), "a number");
}

TEST(Values, ANumberIsTheWholeOfTheText) {
  EXPECT_EQ(read_number<double>("2.5"), 2.5);
  EXPECT_EQ(read_number<int>("-3"), -3);
  for (const char* text : {"", " 1", "1 ", "1mm", "one"}) {
    EXPECT_FALSE(read_number<double>(text)) << text;
  }
  EXPECT_FALSE(read_number<int>("2.5"));
  EXPECT_FALSE(read_number<std::size_t>("-1"));
  EXPECT_EQ(write_number(0.1), "0.1");
}

TEST(Values, ListsAreSeparatedByBlanksOrCommasPairsBySemicolons) {
  EXPECT_EQ(read_numbers<int>(" 1, 2\t3 "), (std::vector<int>{1, 2, 3}));
  EXPECT_FALSE(read_numbers<int>("1 two"));
  EXPECT_EQ(read_number_pairs("842,-4.7; 10 2"), (std::vector<std::pair<double, double>>{{842, -4.7}, {10, 2}}));
  EXPECT_EQ(read_number_pairs(" ")->size(), 0U);
  EXPECT_FALSE(read_number_pairs("1,2;3"));
}

TEST(Values, RangesOfLabelsAreWrittenOut) {
  EXPECT_EQ(read_ranges("2 3, 10-13"), (std::vector<std::uint16_t>{2, 3, 10, 11, 12, 13}));
  EXPECT_EQ(read_ranges(""), std::vector<std::uint16_t>{});
  for (const char* bad : {"0", "-2", "3-", "5-4", "1-99999", "two", "1.5"}) {
    EXPECT_FALSE(read_ranges(bad)) << bad;
  }
}

}  // namespace brainshift::values_test
