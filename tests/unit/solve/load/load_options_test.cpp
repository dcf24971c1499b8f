// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/load_options.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::solve::load_options_test {

using test::refusal;

std::string fault(const OpeningOptions& options) {
  return refusal([&] { check_table(opening_options(), options); });
}

std::string fault(const SimulatedCraniotomy& opening) {
  return refusal([&] { check_table(simulated_craniotomy_options(), opening); });
}

// A new member of a struct does not compile here: it goes into the table.
TEST(LoadOptions, AreAllInTheirTables) {
  [[maybe_unused]] const auto& [margin, depth, farthest] = OpeningOptions{};
  [[maybe_unused]] const auto& [centre, radius, sinking] = SimulatedCraniotomy{};
  EXPECT_EQ(opening_options().size(), 3U);
  EXPECT_EQ(simulated_craniotomy_options().size(), 3U);
}

TEST(LoadOptions, OfAnOpeningMayHaveAnyMarginButDepthsAboveZero) {
  EXPECT_EQ(fault(OpeningOptions{}), "");
  EXPECT_EQ(fault(OpeningOptions{.margin = -7}), "");
  EXPECT_EQ(fault(OpeningOptions{.margin = std::nan("")}), "margin is 'nan', but must be a number (mm)");
  EXPECT_EQ(fault(OpeningOptions{.depth = 0}), "depth is '0', but must be a number > 0 (mm)");
  EXPECT_EQ(fault(OpeningOptions{.farthest = -2}), "farthest is '-2', but must be a number > 0 (mm)");
}

TEST(LoadOptions, OfASimulatedCraniotomyNeedAPlace) {
  EXPECT_EQ(fault(SimulatedCraniotomy{}), "");
  EXPECT_EQ(fault(SimulatedCraniotomy{.radius = 0}), "radius is '0', but must be a number > 0 (mm)");
  EXPECT_EQ(fault(SimulatedCraniotomy{.depth = -1}), "depth is '-1', but must be a number > 0 (mm)");
  EXPECT_EQ(fault(SimulatedCraniotomy{.centre = {1, std::nan(""), 3}}),
            "centre is '1 nan 3', but must be three numbers (mm, LPS)");
  for (const auto& option : simulated_craniotomy_options()) {
    EXPECT_EQ(option.required, option.name == "centre") << "there is no place that suits every brain";
  }
}

TEST(LoadOptions, AreReadIntoTheMembersOfTheirNames) {
  OpeningOptions opening;
  SimulatedCraniotomy simulated;
  for (const auto& [name, text] : {std::pair("margin", "1"), {"depth", "2"}, {"farthest", "3"}}) {
    ASSERT_TRUE(set_option(*find_option(opening_options(), name), opening, text));
  }
  for (const auto& [name, text] : {std::pair("centre", "1 2 3"), {"radius", "4"}, {"depth", "5"}}) {
    ASSERT_TRUE(set_option(*find_option(simulated_craniotomy_options(), name), simulated, text));
  }
  EXPECT_EQ(Eigen::Vector3d(opening.margin, opening.depth, opening.farthest), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(simulated.centre, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(simulated.radius, 4);
  EXPECT_EQ(simulated.depth, 5);
}

}  // namespace brainshift::solve::load_options_test
