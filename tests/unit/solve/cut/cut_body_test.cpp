// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_body.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/cut_bodies.hpp"

namespace brainshift::solve::cut_body_test {

using test::cut_path;
using test::strip;

TEST(CutBody, SplitsNodesOnThePathAndAddsPairsBetween) {
  Model model = strip(1.2);
  model.conditions.force = Points::Constant(model.cloud.positions.rows(), 3, 1e-3);
  model.cuts = {cut_path({{-1, 10}, {15, 10}})};
  const CutBody body = cut_body(model);
  ASSERT_GT(body.split, 0u);
  EXPECT_EQ(body.cloud.size(), model.cloud.size() + 2 * body.pairs.size() - body.split);
  EXPECT_NEAR(body.conditions.force.sum(), model.conditions.force.sum(), 1e-12);
  for (const FacePair& p : body.pairs) {
    EXPECT_GT(body.cloud.positions(p.above, 1), 10);
    EXPECT_LT(body.cloud.positions(p.below, 1), 10);
    EXPECT_NEAR((body.cloud.positions.row(p.above) - body.cloud.positions.row(p.below)).norm(), 4e-3, 1e-9);
    EXPECT_LT(p.place.x(), 15 - 0.99) << "half a spacing from the tip";
    EXPECT_NE(body.cloud.on_surface[static_cast<std::size_t>(p.above)], 0);
  }
  std::vector<double> along;
  for (const FacePair& p : body.pairs) {
    along.push_back(p.place.x());
  }
  std::sort(along.begin(), along.end());
  for (std::size_t i = 1; i < along.size(); ++i) {
    EXPECT_LT(along[i] - along[i - 1], 2 * 1.6);
    EXPECT_GT(along[i] - along[i - 1], 2 * 0.59);
  }
}

/// Of a body that takes little of a large triangle, and not its middle.
TEST(CutBody, IsMetBySheetsOfLargeTriangles) {
  Model model;
  model.cloud = test::irregular_box(7, 18);
  model.conditions = test::all_free(model.cloud);
  model.cells = test::box_cells(6, 18);
  model.materials[1] = {3000, 0.45, 1000};
  for (const double off : {0.0, 40.0}) {
    Cut sheet{"sheet", Points(4, 3), Triangles(2, 3), {}};
    sheet.vertices << -100, -30, 9 + off, 190, -30, 9 + off, 190, 270, 9 + off, -100, 270, 9 + off;
    sheet.triangles << 0, 1, 2, 0, 2, 3;
    model.cuts = {sheet};
    if (off == 0) {
      EXPECT_FALSE(cut_body(model).pairs.empty());
    } else {
      EXPECT_THROW(cut_body(model), std::invalid_argument);
    }
  }
}

}  // namespace brainshift::solve::cut_body_test
