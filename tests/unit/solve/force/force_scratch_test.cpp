// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/force_scratch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve::force_scratch_test {

Specimen square() {
  return {test::irregular_rectangle(6, 6, 20, 20),
          test::rectangle_cells(5, 5, 20, 20),
          {{.poisson_ratio = 0.4}},
          {.nodes_per_patch = 0, .points_per_cell = 4}};
}

TEST(ForceScratch, HasRoomOnlyForWhatTheLawsRemember) {
  const Specimen body = square();
  PointLaws laws = body.laws;
  const ForceScratch plain(body.points, laws);
  EXPECT_TRUE(plain.jacobian.empty());
  EXPECT_TRUE(plain.thickness.empty());
  EXPECT_TRUE(plain.viscous_begin.empty());
  laws.in_time = laws.plane_stress = true;
  const ForceScratch more(body.points, laws);
  EXPECT_EQ(more.jacobian, std::vector<double>(100, 1.0)) << "undeformed";
  EXPECT_EQ(more.thickness, std::vector<double>(100, 1.0));
}

TEST(ForceScratch, TakesOverWhatPointsRememberInTheirNewOrder) {
  const Specimen body = square();
  PointLaws laws = body.laws;
  laws.in_time = laws.plane_stress = true;
  ForceScratch before(body.points, laws), after = before;
  std::iota(before.jacobian.begin(), before.jacobian.end(), 0.0);
  std::iota(before.thickness.begin(), before.thickness.end(), 1000.0);
  std::vector<std::int32_t> from(100);
  std::iota(from.begin(), from.end(), 0);
  std::reverse(from.begin(), from.end());
  after.remember(before, from);
  for (std::size_t i = 0; i < from.size(); ++i) {
    EXPECT_EQ(after.jacobian[i], static_cast<double>(from[i]));
    EXPECT_EQ(after.thickness[i], 1000.0 + from[i]);
  }
}

}  // namespace brainshift::solve::force_scratch_test
