// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/options/option.hpp"

#include <gtest/gtest.h>

namespace brainshift::option_test {

enum class Shade : std::uint8_t { light, dark, unnamed };

struct Paint {
  double litres = 2;
  std::optional<int> coats = {};
  Shade shade = Shade::light;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> drip = {};
  std::vector<std::uint16_t> labels = {1};
  std::vector<std::pair<double, double>> stripes = {};
};

struct Wall {
  Paint paint = {};
};

OptionTable<Paint> paint_options() {
  return {number_option<Paint>("litres", &Paint::litres, above_zero, "l", "how much"),
          number_option<Paint>("coats", &Paint::coats, {.low = 1, .high = 3}, "", "how often"),
          choice_option<Paint>("shade", &Paint::shade, {{"light", Shade::light}, {"dark", Shade::dark}}, "which"),
          vector_option<Paint>("place", &Paint::place, "mm", "where"),
          vector_option<Paint>("drip", &Paint::drip, "mm", "where it ran to"),
          labels_option<Paint>("labels", &Paint::labels, "of what"),
          pairs_option<Paint>("stripes", &Paint::stripes, "pairs from,to", "mm", "from where to where")};
}

std::string complaint(const Paint& paint) {
  try {
    check_table(paint_options(), paint);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(Option, TheCheckOfAStructSaysWhatReadingItsTextSays) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint({}), "");
  EXPECT_EQ(complaint({.litres = 0}), "litres is '0', but must be a number > 0 (l)");
  EXPECT_EQ(complaint({.coats = 4}), "coats is '4', but must be a whole number from 1 to 3, or nothing");
  EXPECT_EQ(complaint({.shade = Shade::unnamed}), "shade is '2', but must be light | dark");
  EXPECT_EQ(complaint({.place = {0, nan, 0}}), "place is '0 nan 0', but must be three numbers (mm)");
  EXPECT_EQ(complaint({.drip = Eigen::Vector3d(0, nan, 0)}),
            "drip is '0 nan 0', but must be three numbers, or nothing (mm)");
  EXPECT_EQ(complaint({.labels = {1, 0}}),
            "labels is '1 0', but must be whole numbers from 1 to 65535, separated by blanks");
  EXPECT_EQ(complaint({.stripes = {{1, nan}}}), "stripes is '1,nan', but must be pairs from,to (mm)");
  const Option<Paint> litres = *find_option(paint_options(), "litres");
  Paint paint;
  EXPECT_FALSE(set_option(litres, paint, "0"));
  EXPECT_EQ(refusal(litres, "0"), complaint({.litres = 0}));
}

TEST(Option, WhatItWritesItReadsBack) {
  const Paint paint{.litres = 0.1,
                    .coats = 3,
                    .shade = Shade::dark,
                    .place = {1, -2, 0.5},
                    .drip = Eigen::Vector3d(0, 0, -3),
                    .labels = {7, 9},
                    .stripes = {{1, 2}, {3, 4}}};
  Paint copy;
  for (const auto& option : paint_options()) {
    ASSERT_TRUE(set_option(option, copy, option.get(paint))) << option.name;
    EXPECT_EQ(option.get(copy), option.get(paint));
  }
  EXPECT_EQ(copy.litres, 0.1);
  EXPECT_EQ(copy.coats, 3);
  EXPECT_EQ(copy.shade, Shade::dark);
  EXPECT_EQ(copy.place, paint.place);
  EXPECT_EQ(copy.drip, paint.drip);
  EXPECT_EQ(copy.labels, paint.labels);
  EXPECT_EQ(copy.stripes, paint.stripes);
  EXPECT_TRUE(set_option(*find_option(paint_options(), "coats"), copy, ""));
  EXPECT_FALSE(copy.coats);
  EXPECT_TRUE(set_option(*find_option(paint_options(), "drip"), copy, ""));
  EXPECT_FALSE(copy.drip);
}

TEST(Option, ATextOfAnotherKindLeavesTheValue) {
  Paint paint;
  for (const auto& option : paint_options()) {
    EXPECT_FALSE(option.read(paint, "no such thing")) << option.name;
    EXPECT_EQ(option.get(paint), option.get(Paint{}));
  }
}

TEST(Option, OfAPartIsOneOfTheWhole) {
  const OptionTable<Wall> table = of_whole<Wall>(paint_options(), &Wall::paint);
  ASSERT_EQ(table.size(), paint_options().size());
  Wall wall;
  EXPECT_TRUE(set_option(*find_option(table, "litres"), wall, "5"));
  EXPECT_EQ(wall.paint.litres, 5);
  EXPECT_EQ(find_option(table, "litres")->get(wall), "5");
  wall.paint.coats = 0;
  EXPECT_THROW(check_table(table, wall), std::invalid_argument);
  EXPECT_EQ(option_names(table), "litres, coats, shade, place, drip, labels, stripes");
  EXPECT_EQ(find_option(table, "colour"), nullptr);
}

}  // namespace brainshift::option_test
