// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/slow_parts.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "solve/dynamics/rigid_modes.hpp"
#include "solve/force/stiffness_bound.hpp"
#include "solve/run/prepare.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::slow_parts_test {

constexpr double side = model_side;

/// A soft cube whose lowest nodes are held, with a stiff cube of a third of its side in it.
Model cube_in_cube(double contrast) {
  Model model = box_model(test::box_cells(9, side), 10);
  model.materials[2] = model.materials[1];
  model.materials[2].youngs_modulus *= contrast;
  test::label_cells(model.cells, [](const Eigen::RowVector3d& low) {
    const Eigen::Array3d away = (low.transpose().array() - side / 3).round();
    return (away >= 0).all() && (away < side / 3).all() ? 2 : 1;
  });
  hold_bottom(model);
  return model;
}

Body body_of(const Model& model) {
  SolveMeasures measures;
  return prepare(model, {}, {}, measures, {}).body;
}

struct Slow {
  Body body;
  std::vector<double> mass;
  double eigenvalue = 0;

  explicit Slow(double contrast) : body(body_of(cube_in_cube(contrast))) {
    const NodalVectors rest(4 * body.nodes(), 0.0);
    NodalVectors force(rest.size());
    ForceScratch scratch(body.points, body.laws);
    internal_force(body.points, body.laws, rest, scratch, force);
    mass = stiffness_bound(body.points, body.laws, scratch);
    eigenvalue = slowest_rigid_motion(body, body.stiff_parts, mass, rest, scratch);
  }
};

TEST(SlowParts, AreSlowerTheStifferTheyAre) {
  const Slow hundred(100), thousand(1000);
  ASSERT_EQ(hundred.body.stiff_parts.size(), 1U);
  EXPECT_GT(hundred.eigenvalue, 0);
  EXPECT_LT(hundred.eigenvalue, 0.03);
  EXPECT_NEAR(thousand.eigenvalue / hundred.eigenvalue, 0.1, 0.03);
}

TEST(SlowParts, AreNoneOfABodyWithout) {
  const Slow none(10);
  EXPECT_TRUE(none.body.stiff_parts.empty());
  EXPECT_TRUE(std::isinf(none.eigenvalue));
}

TEST(SlowParts, HaveModesOrAreTheOthers) {
  Body body = body_of(cube_in_cube(100));
  EXPECT_EQ(free_stiff_parts(body).size(), 1U) << "three spacings from what is held";
  EXPECT_TRUE(parts_without_modes(body).empty());
  body.stiff_parts.push_back({body.essential.nodes().front()});
  EXPECT_EQ(free_stiff_parts(body).size(), 1U);
  EXPECT_EQ(parts_without_modes(body), NodeLists{body.stiff_parts.back()});
  while (body.stiff_parts.size() < 7) {
    body.stiff_parts.push_back({body.stiff_parts[0][body.stiff_parts.size()]});
  }
  EXPECT_EQ(parts_without_modes(body).size(), body.stiff_parts.size() - RigidModes::most_parts);
}

TEST(SlowParts, MoveAsRigidBodiesWhereTheyAreToldTo) {
  const Body body = body_of(cube_in_cube(100));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  NodalVectors turned(4 * body.nodes(), 0.0);
  for (std::size_t a = 0; a < body.nodes(); ++a) {
    const Eigen::Vector3d x = body.positions.row(body.original[a]);
    at(turned, a).head<3>() = turn * x + Eigen::Vector3d(1, 2, 3) - x;
  }
  EXPECT_LT(largest_difference(with_rigid_parts(body, turned), turned), 1e-9) << "it was rigid";
  NodalVectors bent = turned;
  const auto node = static_cast<std::size_t>(body.stiff_parts[0][0]);
  at(bent, node)[0] += 1;
  const NodalVectors rigid = with_rigid_parts(body, bent);
  EXPECT_LT((at(rigid, node) - at(turned, node)).norm(), 0.5);
  EXPECT_GT(largest_difference(rigid, turned), 1e-3) << "the part goes along a little";
}

}  // namespace brainshift::solve::slow_parts_test
