// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/touched_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "solve/shape/node_supports.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/solve/cut_bodies.hpp"

namespace brainshift::solve::touched_rows_test {

constexpr double width = 40, height = 20;
const ShapeOptions planar{.planar = true};

struct Rectangle {
  NodeCloud cloud = test::irregular_rectangle(21, 11, width, height);
  std::vector<double> radius = support_radii(cloud.spacing, planar);
  Points at = places();
  ShapeRows rows = ShapeFunctions(cloud.positions, cloud.spacing, planar).evaluate(at, true);

  static Points places() {
    Points p = test::random_points(400, 1);
    p.array().rowwise() *= Eigen::RowVector3d(width, height, 0).array();
    return p;
  }
  std::vector<std::int32_t> touched(const Visibility& fresh, std::span<const std::int32_t> nodes = {}) const {
    return touched_rows(rows, at, {fresh, nodes, cloud.positions, radius});
  }
};

bool same_row(const ShapeRow& a, const ShapeRow& b) {
  return std::ranges::equal(a.node, b.node) && std::ranges::equal(a.value, b.value) &&
         std::ranges::equal(a.derivative, b.derivative);
}

/// What is evaluated again with the cut there is the same, but in rows that were named.
TEST(TouchedRows, HoldEveryRowThatACutChangesAndFewOthers) {
  const Rectangle body;
  const CutFacets cut = test::path({{-1, 10}, {12, 10}}, true);
  const Visibility fresh(cut);
  const std::vector<std::int32_t> touched = body.touched(fresh);
  EXPECT_TRUE(std::is_sorted(touched.begin(), touched.end()));
  EXPECT_LT(touched.size(), body.rows.size() / 2);
  const ShapeRows after =
      ShapeFunctions(body.cloud.positions, body.cloud.spacing, planar, std::make_shared<const Visibility>(cut))
          .evaluate(body.at, true);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (!same_row(after[i], body.rows[i])) {
      ++changed;
      EXPECT_TRUE(std::binary_search(touched.begin(), touched.end(), static_cast<std::int32_t>(i)))
          << "at " << body.at.row(static_cast<Eigen::Index>(i));
    }
  }
  EXPECT_GT(changed, touched.size() / 4) << "the test must see rows that change";
}

TEST(TouchedRows, AreThoseThatSeeANodeThatMoved) {
  const Rectangle body;
  const Visibility far_away(test::path({{-200, 0}, {-190, 0}}, false));
  EXPECT_TRUE(body.touched(far_away).empty());
  const std::vector<std::int32_t> moved = {115};
  const std::vector<std::int32_t> touched = body.touched(far_away, moved);
  ASSERT_FALSE(touched.empty());
  for (std::size_t i = 0; i < body.rows.size(); ++i) {
    const bool sees = std::ranges::find(body.rows[i].node, 115) != body.rows[i].node.end();
    const bool is_near =
        (body.at.row(static_cast<Eigen::Index>(i)) - body.cloud.positions.row(115)).norm() < body.radius[115];
    EXPECT_EQ(std::binary_search(touched.begin(), touched.end(), static_cast<std::int32_t>(i)), sees || is_near);
  }
}

ShapeRows rows_of(const std::vector<double>& values) {
  ShapeRows rows;
  for (const double& value : values) {
    const std::int32_t node = 3;
    rows.append({std::span(&node, 1), std::span(&value, 1), {}});
  }
  return rows;
}

TEST(WithRows, ReplacesInOrderAndAppendsWhatIsNew) {
  ShapeRows before = rows_of({0, 1, 2, 3}), others = rows_of({10, 30, 40, 50});
  before.grown = 2;
  others.grown = 1;
  const ShapeRows joined = with_rows(before, std::vector<std::int32_t>{1, 3, 4, 5}, others);
  EXPECT_EQ(joined.value, (std::vector<double>{0, 10, 2, 30, 40, 50}));
  EXPECT_EQ(joined.size(), 6U);
  EXPECT_EQ(joined.grown, 3U);
  EXPECT_EQ(with_rows(before, {}, rows_of({})).value, before.value);
}

}  // namespace brainshift::solve::touched_rows_test
