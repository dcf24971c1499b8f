// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/update/other_load.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solve/run/thinned_body.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::other_load_test {

constexpr int cells = 8;  // along each edge

/// Of more nodes than a thinned body has, held below and loaded at every other node of its upper face.
Model half_loaded(int which) {
  Model model = box_model(test::box_cells(cells, model_side), cells + 1);
  hold_bottom(model);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    if (x[2] > model_side - 1e-9 && std::lround((x[0] + x[1]) * cells / model_side) % 2 == which) {
      model.conditions.displacement.row(a) << 0, 0, -4;
    }
  }
  return model;
}

TEST(ThinFor, IsTheBodyOfARunUnderThatLoad) {
  const Model own = half_loaded(0), other = half_loaded(1);
  KeptRun run;
  run.fine.body.positions = own.cloud.positions;
  run.origin.prescribed = own.conditions.displacement;
  run.thinned = thinned_body(own, {});
  const std::vector<std::int32_t> nodes = run.thinned->node;
  thin_for(other.conditions, run);
  EXPECT_EQ(run.thinned->node, nodes) << "nobody says what it was made from";
  run.made_from = [&] { return own; };
  thin_for(other.conditions, run);
  EXPECT_EQ(run.thinned->node, thinned_body(other, {}).node);
  EXPECT_NE(run.thinned->node, nodes);
  thin_for(own.conditions, run);
  EXPECT_EQ(run.thinned->node, nodes);
}

}  // namespace brainshift::solve::other_load_test
