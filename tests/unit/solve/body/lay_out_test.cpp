// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/lay_out.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "solve/quadrature/cell_points.hpp"
#include "solve/shape/shape_functions.hpp"
#include "solve/shape/too_few_nodes.hpp"
#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::lay_out_test {

constexpr double side = model_side;

BodyParts parts_of(const Model& model, double nodes_per_patch = 4, const ShapeOptions& options = {}) {
  BodyParts parts;
  parts.cloud = order_nodes(model.cloud, model.conditions);
  const ShapeFunctions shape(parts.cloud.positions, parts.cloud.spacing, options);
  parts.nodal_rows = shape.evaluate(parts.cloud.positions, false);
  parts.points = integration_points(model.cells, 8, nullptr, {1, 2});
  parts.point_rows = shape.evaluate(parts.points.positions, true);
  parts.materials = material_table(model.materials, parts.points.label);
  const std::vector<double> share(parts.points.size(),
                                  static_cast<double>(model.cloud.size()) / static_cast<double>(parts.points.size()));
  parts.patches = pressure_patches(parts.points.positions, share, parts.materials.row_of_point, nodes_per_patch);
  return parts;
}

Model small_box() {
  return box_model(test::box_cells(4, side), 5);
}

TEST(LayOut, KeepsTheCloudsOwnOrderBesideThatOfStepping) {
  const Model model = small_box();
  const Body body = lay_out(model, {}, parts_of(model), {});
  EXPECT_EQ(body.nodes(), model.cloud.size());
  EXPECT_EQ(body.positions, model.cloud.positions);
  EXPECT_EQ(body.spacing, model.cloud.spacing);
  EXPECT_TRUE(body.external.empty()) << "nothing pushes";
  EXPECT_TRUE(body.mass.empty()) << "relaxation makes its own";
}

TEST(LayOut, PlacesThePointsInTheOrderOfTheBlocks) {
  Model model = small_box();
  model.materials[2] = model.materials[1];
  for (std::size_t cell = 0; cell < model.cells.size(); cell += 3) {
    model.cells.label[cell] = 2;
  }
  const BodyParts parts = parts_of(model);
  const Body body = lay_out(model, {}, parts, {});
  ASSERT_EQ(body.placed.tissue.size(), parts.points.size());
  for (std::size_t k = 0; k < parts.points.size(); ++k) {
    const auto p = static_cast<std::size_t>(parts.patches.order[k]);
    EXPECT_EQ(body.placed.position.row(static_cast<Eigen::Index>(k)),
              parts.points.positions.row(static_cast<Eigen::Index>(p)));
    EXPECT_EQ(body.placed.tissue[k], parts.points.label[p]);
    EXPECT_EQ(body.points.volume[k], parts.points.volume[p]);
  }
}

TEST(LayOut, AddsUpTheForcesOnTheBody) {
  Model model = small_box();
  model.gravity = {0, 0, -9.81};
  model.body_force = [](const Eigen::Vector3d&, std::int32_t) { return Eigen::Vector3d(1e-6, 0, 0); };  // N/mm³
  model.conditions.force = Points::Zero(model.cloud.positions.rows(), 3);
  model.conditions.force.row(62) << 0, 0.25, 0;  // N
  const NodalVectors force = lay_out(model, {}, parts_of(model), {}).external.full();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t a = 0; a < model.cloud.size(); ++a) {
    sum += at(force, a).head<3>();
  }
  const double volume = side * side * side, weight = 1000e-9 * volume * 9.81;  // N
  EXPECT_LE((sum - 1e6 * Eigen::Vector3d(1e-6 * volume, 0.25, -weight)).norm(), 1e-6 * 1e6 * weight) << "µN";
}

TEST(LayOut, GivesMassInTimeAndTheLawsOfItsRelaxation) {
  Model model = small_box();
  model.materials[1].prony = {{0.4, 1}};
  const BodyParts parts = parts_of(model);
  const Body at_rest = lay_out(model, {}, parts, {}), moving = lay_out(model, in_time(), parts, {});
  const double whole = 1e-3 * side * side * side;  // g
  EXPECT_NEAR(std::accumulate(moving.mass.begin(), moving.mass.end(), 0.0), whole, 1e-9 * whole);
  EXPECT_EQ(moving.prony.size(), 1U);
  EXPECT_TRUE(at_rest.prony.empty());
  const double now = std::get<NeoHookean>(moving.laws.elastic[0]).shear_modulus;
  EXPECT_NEAR(std::get<NeoHookean>(at_rest.laws.elastic[0]).shear_modulus, 0.6 * now, 1e-9 * now) << "it has relaxed";
}

TEST(LayOut, AFreeBodyFallsAsOne) {
  Model model = small_box();
  model.gravity = {0, 0, -9.81};
  for (const Basis basis : {Basis::linear, Basis::modified_quadratic}) {
    const Body body = lay_out(model, in_time(), parts_of(model, 4, {.basis = basis}), {});
    double weight = 0;
    for (std::size_t a = 0; a < body.mass.size(); ++a) {
      EXPECT_NEAR(at(body.external.full(), a).z() / body.mass[a], -9810, 1e-6) << "mm/s²";
      EXPECT_GT(body.mass[a], 0);
      weight += at(body.external.full(), a).z();
    }
    EXPECT_NEAR(weight, -9810 * 1e-3 * side * side * side, 1e-6 * 9810 * 1e-3 * side * side * side) << "µN";
  }
}

/// Contact does not know the unit of length: the samples of the skull's distance are as near as the nodes ask for.
TEST(LayOut, ASmallBodyHasAFinerSkull) {
  Model model = small_box();
  model.skull = test::box(Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(side + 1));
  const auto spacing = [&] { return lay_out(model, {}, parts_of(model), {}).contact->skull()->samples().spacing; };
  EXPECT_EQ(spacing(), 1.5) << "of a head";
  constexpr double smaller = 0.1;
  model.cloud.positions *= smaller;
  model.cells.vertices *= smaller;
  model.skull->vertices *= smaller;
  for (double& s : model.cloud.spacing) {
    s *= smaller;
  }
  EXPECT_NEAR(spacing(), model.cloud.spacing[62] / 3, 0.2 * model.cloud.spacing[62]);
  EXPECT_LE(spacing(), 0.4 * model.cloud.spacing[62]);
}

TEST(LayOut, RefusesANodeThatNoPointSeesByItsNumberInTheCloud) {
  Model model = small_box();
  BodyParts parts = parts_of(model);
  const std::int32_t lost = parts.cloud.original[3];
  for (std::size_t i = 0; i < parts.point_rows.node.size(); ++i) {
    std::int32_t& node = parts.point_rows.node[i];
    node = node == 3 ? 2 : node;
  }
  try {
    lay_out(model, {}, parts, {});
    FAIL() << "laid out";
  } catch (const TooFewNodes& fault) {
    EXPECT_EQ(std::string(fault.what()).find("node " + std::to_string(lost) + " lies in the support of no"), 0U)
        << fault.what();
  }
}

}  // namespace brainshift::solve::lay_out_test
