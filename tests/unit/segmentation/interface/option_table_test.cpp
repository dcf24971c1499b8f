// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/interface/option_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::segmentation::option_table_test {

using test::refusal;

std::string fault(double edge_length, int classes, double ventricle_depth) {
  SegmentOptions options;
  options.edge_length = edge_length;
  options.classes = classes;
  options.ventricle_depth = ventricle_depth;
  return refusal([&] { check_options(options); });
}

// A new member of the struct does not compile here. It goes into the table, or among those that the scene fills in.
TEST(SegmentOptions, AreAllInTheTable) {
  [[maybe_unused]] const auto& [edge_length, classes, ventricle_depth, closing, tissue_surfaces, brain_labels,
                                skull_label, fluid_label] = SegmentOptions{};
  EXPECT_EQ(segment_options().size() + 3, 8U) << "beside the labels";
}

TEST(SegmentOptions, AreAllowedAsTheyAreByDefaultAndAtTheirEnds) {
  EXPECT_EQ(refusal([] { check_options({}); }), "");
  EXPECT_EQ(fault(0.5, 2, 0), "");
  EXPECT_EQ(fault(1e9, 10, 15), "");
}

TEST(SegmentOptions, OutOfRangeAreRefusedWithTheirUnit) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(fault(0, 3, 15), "edge_length is '0', but must be a number >= 0.5 (mm)");
  EXPECT_EQ(fault(std::nan(""), 3, 15), "edge_length is 'nan', but must be a number >= 0.5 (mm)");
  EXPECT_EQ(fault(5, 1, 15), "classes is '1', but must be a whole number from 2 to 10");
  EXPECT_EQ(fault(5, 11, 15), "classes is '11', but must be a whole number from 2 to 10");
  EXPECT_EQ(fault(5, 3, -1), "ventricle_depth is '-1', but must be a number >= 0 (mm)");
  EXPECT_EQ(fault(5, 3, infinity), "ventricle_depth is 'inf', but must be a number >= 0 (mm)");
}

TEST(SegmentOptions, AreReadIntoTheMembersOfTheirNames) {
  SegmentOptions options;
  for (const auto& [name, text] : {std::pair("edge_length", "2.5"),
                                   {"classes", "4"},
                                   {"ventricle_depth", "7"},
                                   {"closing", "0"},
                                   {"tissue_surfaces", "yes"}}) {
    ASSERT_TRUE(set_option(*find_option(segment_options(), name), options, text)) << name;
  }
  EXPECT_EQ(options.edge_length, 2.5);
  EXPECT_EQ(options.classes, 4);
  EXPECT_EQ(options.ventricle_depth, 7);
  EXPECT_EQ(options.closing, 0);
  EXPECT_TRUE(options.tissue_surfaces);
  options.closing = 21;
  EXPECT_EQ(refusal([&] { check_options(options); }),
            "closing is '21', but must be a number from 0 to 20, or nothing (mm)");
}

}  // namespace brainshift::segmentation::option_table_test
