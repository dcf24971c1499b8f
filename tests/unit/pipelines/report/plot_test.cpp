// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/plot.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::plot_test {

struct Drawn {
  std::vector<std::string> texts, paths;
  std::size_t dots = 0;

  bool says(const std::string& text) const { return std::ranges::find(texts, text) != texts.end(); }
};

Drawn drawn(const Plot& plot) {
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(plot_svg(plot).c_str()), tinyxml2::XML_SUCCESS);
  Drawn result;
  for (const auto* e = document.RootElement()->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    const std::string name = e->Name();
    if (name == "text" && e->GetText() != nullptr) {
      result.texts.emplace_back(e->GetText());
    } else if (name == "path") {
      result.paths.emplace_back(e->Attribute("d"));
    }
    result.dots += name == "circle" ? 1 : 0;
  }
  return result;
}

Plot line_of(std::vector<double> x, std::vector<double> y) {
  return {.file = "f", .title = "t", .x_label = "x", .y_label = "y", .series = {{"s", std::move(x), std::move(y)}}};
}

TEST(Plot, NamesItsAxesAndSeriesAndHasRoundTicks) {
  const Drawn plot = drawn(line_of({0, 1000}, {0, 0.5}));
  for (const char* text : {"t", "x", "y", "s", "0", "200", "1,000", "0.1", "0.5"}) {
    EXPECT_TRUE(plot.says(text)) << text;
  }
}

TEST(Plot, LogarithmicTicksAreDecadesOverManyOfThem) {
  Plot plot = line_of({1, 2}, {1e-6, 1});
  plot.scale = Scale::log_log;
  const Drawn many = drawn(plot);
  EXPECT_TRUE(many.says("0.001"));
  EXPECT_FALSE(many.says("0.002"));
  plot.series[0].y[0] = 0.01;
  EXPECT_TRUE(drawn(plot).says("0.02"));
}

TEST(Plot, LeavesOutWhatCannotBeShown) {
  Plot plot = line_of({1, 2, 3, 4}, {1, std::nan(""), 0, 10});
  plot.scale = Scale::log_log;
  EXPECT_EQ(drawn(plot).dots, 2U);
  plot.series[0].y = {std::nan(""), std::nan(""), std::nan(""), std::nan("")};
  EXPECT_EQ(drawn(plot).dots, 0U);
}

TEST(Plot, ManyPointsAreJoinedWithoutDots) {
  std::vector<double> x, y;
  for (int i = 0; i < 50; ++i) {
    x.push_back(i);
    y.push_back(i);
  }
  Plot plot = line_of(x, y);
  EXPECT_EQ(drawn(plot).dots, 0U);
  plot.series[0].joined = false;
  EXPECT_EQ(drawn(plot).dots, 50U);
}

TEST(Plot, IsWrittenAsAFileOrSaysWhichItCouldNotWrite) {
  const test::ScratchFolder folder;
  draw(folder.path(), line_of({0, 1}, {0, 1}));
  EXPECT_TRUE(std::filesystem::exists(folder / "f.svg"));
  try {
    draw(folder / "none", line_of({0, 1}, {0, 1}));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("f.svg"), std::string::npos);
  }
}

}  // namespace brainshift::pipelines::plot_test
