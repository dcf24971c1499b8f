// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/surface_figure.hpp"

#include <gtest/gtest.h>

#include "tests/unit/pipelines/report/small_run.hpp"

namespace brainshift::pipelines::surface_figure_test {

bool has(const Figure& figure, const std::string& text) {
  return figure.svg.find(text) != std::string::npos;
}

TEST(SurfaceFigure, ShowsTheOpeningWithItsRimAndFromTheSide) {
  const RunData run = small_run();
  const Figure figure = surface_figure(run, make_view(run));
  for (const char* text : {"seen through the opening", "from the side", "shift, mm", ">P<", "stroke=\"#143ca0\""}) {
    EXPECT_TRUE(has(figure, text)) << text;
  }
}

TEST(SurfaceFigure, HasNoRimWhereNothingIsLoaded) {
  RunData run = small_run();
  run.solution->reaction_force.setZero();
  const Figure figure = surface_figure(run, make_view(run));
  EXPECT_TRUE(has(figure, "from above"));
  EXPECT_FALSE(has(figure, "stroke=\"#143ca0\""));
}

}  // namespace brainshift::pipelines::surface_figure_test
