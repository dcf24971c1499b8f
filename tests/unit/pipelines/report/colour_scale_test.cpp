// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/colour_scale.hpp"

#include <gtest/gtest.h>

namespace brainshift::pipelines::colour_scale_test {

TEST(ColourScale, PassesFromNodeToNodeAndStaysAtTheEnds) {
  const ColourScale scale{.map = ColourMap::sequential, .low = 0, .high = 5};
  for (std::size_t node = 0; node < 6; ++node) {
    EXPECT_EQ(scale.colour_of(static_cast<double>(node)), scale.nodes()[node]);
  }
  EXPECT_EQ(scale.colour_of(0.5), blend(scale.nodes()[0], scale.nodes()[1], 0.5));
  EXPECT_EQ(scale.colour_of(-1), scale.nodes().front());
  EXPECT_EQ(scale.colour_of(9), scale.nodes().back());
}

TEST(ColourScale, RoundsUpToWhatQuartersWell) {
  EXPECT_EQ(round_up(7.99), 8);
  EXPECT_EQ(round_up(8), 8);
  EXPECT_EQ(round_up(8.1), 10);
  EXPECT_NEAR(round_up(0.013), 0.016, 1e-12);
  EXPECT_EQ(round_up(0), 1);
}

TEST(ColourScale, TheBarSaysItsTitleAndItsNumbers) {
  Svg svg("p", "", 100, 100);
  draw_colour_bar(svg, {.map = ColourMap::diverging, .low = -100, .high = 100, .title = "% of range"}, {0, 20}, 70,
                  colour::ink);
  const std::string text = std::move(svg).str();
  for (const char* label : {">% of range<", ">-100<", ">-50<", ">0<", ">50<", ">100<"}) {
    EXPECT_NE(text.find(label), std::string::npos) << label;
  }
}

}  // namespace brainshift::pipelines::colour_scale_test
