// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/matching.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solve/cut/cut_body.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/solve/cut_bodies.hpp"

namespace brainshift::solve::matching_test {

using test::cut_path;
using test::strip;

TEST(Matching, CarriesALinearFieldOverExactly) {
  Model model = strip(1.2);
  const ShapeOptions options{.planar = true};
  const ShapeFunctions before(model.cloud.positions, model.cloud.spacing, options);
  model.cuts = {cut_path({{-1, 10}, {15, 10}})};
  const CutBody body = cut_body(model);
  const Points& nodes = body.cloud.positions;
  const ShapeFunctions after(nodes, body.cloud.spacing, options, body.visibility);
  std::vector<std::int32_t> near;
  for (Eigen::Index a = 0; a < nodes.rows(); ++a) {
    if (std::abs(nodes(a, 1) - 10) < 4 || a >= model.cloud.positions.rows()) {
      near.push_back(static_cast<std::int32_t>(a));
    }
  }
  const Points places = nodes(std::vector<Eigen::Index>(near.begin(), near.end()), Eigen::all);
  Matching match(near, body.cloud.size());
  match.agree_in_value(before.evaluate(places, true), after.evaluate(places, true));
  match.agree_in_gradient(before.evaluate(places, true), after.evaluate(places, true), 2);
  match.factorise();
  const Eigen::Matrix3d h = Eigen::Matrix3d{{0.1, 0.2, 0}, {-0.05, 0.3, 0}, {0, 0, 0}};
  NodalVectors u(4 * model.cloud.size(), 0.0);
  for (std::size_t a = 0; a < model.cloud.size(); ++a) {
    at(u, a).head<3>() = h * model.cloud.positions.row(static_cast<Eigen::Index>(a)).transpose();
  }
  const NodalVectors carried = match(u);
  for (const std::int32_t a : near) {
    EXPECT_LT((at(carried, static_cast<std::size_t>(a)).head<3>() - h * nodes.row(a).transpose()).norm(), 1e-6);
  }
}

}  // namespace brainshift::solve::matching_test
