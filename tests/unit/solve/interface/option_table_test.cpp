// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/interface/option_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::solve::option_table_test {

using test::expect_parts;
using test::refusal;

/// The sentence about the default options with a change.
template <class Change>
std::string fault(const Change& change) {
  SolveOptions options;
  change(options);
  return refusal([&] { check_options(options); });
}

// A new member of a struct does not compile here. It goes into the table, or among those that the stage fills in.
TEST(SolveOptions, AreAllInTheTable) {
  [[maybe_unused]] const auto& [basis, derivatives, dilatation, penalty, planar] = ShapeOptions{};
  [[maybe_unused]] const auto& [shape, volumetric, nodes_per_patch, integration, consistency_defect, imposition,
                                integration_tolerance, integration_depth, precision, points_per_cell, dynamics,
                                tolerance, load_steps, start, time_step, damping, max_steps, device, region,
                                snapshot_every] = SolveOptions{};
  EXPECT_EQ(solve_options().size() + 2, 4U + 1 + 19) << "beside planar and consistency_defect";
  std::set<std::string> names;
  for (const auto& option : solve_options()) {
    EXPECT_TRUE(names.insert(option.name).second) << option.name << " is there twice";
    EXPECT_FALSE(option.help.empty()) << option.name;
  }
}

TEST(SolveOptions, AreAllowedAsTheyAreByDefaultAndAtTheirEnds) {
  EXPECT_EQ(refusal([] { check_options({}); }), "");
  EXPECT_EQ(fault([](auto& o) { o.shape.dilatation = 10, o.shape.penalty = 0, o.integration_depth = 6; }), "");
  EXPECT_EQ(fault([](auto& o) { o.load_steps = 1, o.max_steps = 1, o.region = 0; }), "");
}

TEST(SolveOptions, OutOfRangeAreRefusedWithTheirUnit) {
  EXPECT_EQ(fault([](auto& o) { o.tolerance = 0; }), "tolerance is '0', but must be a number > 0 (mm)");
  EXPECT_EQ(fault([](auto& o) { o.time_step = -1; }), "time_step is '-1', but must be a number >= 0 (s)");
  EXPECT_EQ(fault([](auto& o) { o.damping = std::nan(""); }), "damping is 'nan', but must be a number >= 0 (1/s)");
  EXPECT_EQ(fault([](auto& o) { o.shape.dilatation = 11; }), "dilatation is '11', but must be a number from 0 to 10");
  EXPECT_EQ(fault([](auto& o) { o.max_steps = 0; }), "max_steps is '0', but must be a whole number >= 1");
  EXPECT_EQ(fault([](auto& o) { o.snapshot_every = -3; }), "snapshot_every is '-3', but must be a whole number >= 0");
  EXPECT_EQ(fault([](auto& o) { o.points_per_cell = 2; }), "points_per_cell is '2', but must be auto | 1 | 3 | 4 | 8");
}

TEST(SolveOptions, OfPointsPerCellAutoIsNone) {
  const Option<SolveOptions>& points = *find_option(solve_options(), "points_per_cell");
  SolveOptions options;
  options.points_per_cell = 8;
  EXPECT_TRUE(set_option(points, options, "auto"));
  EXPECT_FALSE(options.points_per_cell);
  EXPECT_EQ(points.get(options), "auto");
}

TEST(ResectionOptions, NeedLabelsThatTissuesMayHaveAndAnyPressure) {
  const auto fault_of = [](const Resection& resection) {
    return refusal([&] { check_table(resection_options(), resection); });
  };
  EXPECT_EQ(fault_of({.labels = {1, 65535}, .pressure = -50}), "");
  expect_parts(fault_of({.labels = {0}}), {"labels is '0'", "whole numbers from 1 to 65535"});
  EXPECT_EQ(fault_of({.labels = {3}, .pressure = INFINITY}), "pressure is 'inf', but must be a number (Pa)");
  EXPECT_EQ(fault_of({.labels = {3}, .fluid_level = -80}), "");
  expect_parts(fault_of({.labels = {3}, .fluid_level = INFINITY}), {"fluid_level is 'inf'", "mm along gravity"});
  EXPECT_TRUE(find_option(resection_options(), "labels")->required);
}

}  // namespace brainshift::solve::option_table_test
