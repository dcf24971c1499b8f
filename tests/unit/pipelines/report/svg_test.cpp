// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/svg.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>

namespace brainshift::pipelines::svg_test {

TEST(Svg, IsWellFormedWhateverTheTextSays) {
  Svg svg("p", "a \"b\" & <c>", 40, 30);
  svg.text({1, 2}, "x < y & z", {});
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(std::move(svg).str().c_str()), tinyxml2::XML_SUCCESS);
  const auto* root = document.RootElement();
  EXPECT_STREQ(root->Attribute("viewBox"), "0 0 40 30");
  EXPECT_STREQ(root->Attribute("aria-label"), "a \"b\" & <c>");
  EXPECT_STREQ(root->FirstChildElement("text")->GetText(), "x < y & z");
}

TEST(Svg, DrawsLinesWhereTheyAre) {
  Svg svg("p", "", 40, 30);
  svg.line({1, 2}, {3.25, 4}, {.colour = {255, 0, 16}, .width = 2});
  svg.lines({}, {});
  const std::string text = std::move(svg).str();
  EXPECT_NE(text.find("d=\"M1 2L3.25 4\""), std::string::npos) << text;
  EXPECT_NE(text.find("stroke=\"#ff0010\""), std::string::npos) << text;
  EXPECT_EQ(text.find("d=\"\""), std::string::npos) << "no line, no path";
}

TEST(Svg, GradientsOfAPictureHaveIdsOfTheirOwn) {
  constexpr Colour ends[] = {colour::black, colour::white};
  Svg svg("p", "", 40, 30);
  svg.gradient({0, 0}, {1, 2}, ends);
  svg.gradient({9, 0}, {1, 2}, ends);
  const std::string text = std::move(svg).str();
  EXPECT_NE(text.find("url(#p_gradient0)"), std::string::npos);
  EXPECT_NE(text.find("url(#p_gradient1)"), std::string::npos);
}

TEST(Svg, AnArrowsHeadEndsAtItsTip) {
  const auto lines = arrow({0, 0}, {10, 0}, 1);
  ASSERT_EQ(lines.size(), 3U);
  for (const Segment& side : std::span(lines).subspan(1)) {
    EXPECT_EQ(side.from, Eigen::Vector2d(10, 0));
    EXPECT_LT(side.to.x(), 10);
  }
  EXPECT_DOUBLE_EQ(lines[1].to.y(), -lines[2].to.y());
  EXPECT_EQ(arrow({0, 0}, {0.5, 0}, 1).size(), 1U) << "too short for a head";
}

}  // namespace brainshift::pipelines::svg_test
