// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/measured/response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "solve/quadrature/cell_points.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::response_test {

/// Parts of a cube with linear shape functions, and its shape functions at some nodes.
struct Parts {
  Model model = box_model(test::box_cells(6, model_side));
  BodyParts parts;
  std::vector<std::int32_t> at = {24, 171, 310};

  explicit Parts(bool held) {
    model.materials[1].poisson_ratio = 0.3;
    if (held) {
      hold_bottom(model);
    }
    parts.cloud = order_nodes(model.cloud, model.conditions);
    const ShapeFunctions shape(parts.cloud.positions, parts.cloud.spacing, {.basis = Basis::linear});
    parts.points = integration_points(model.cells, 8, nullptr, {1});
    parts.point_rows = shape.evaluate(parts.points.positions, true);
    parts.nodal_rows = shape.evaluate(parts.cloud.positions, false);
    parts.materials = material_table(model.materials, parts.points.label);
    parts.patches.order.resize(parts.points.size());
    std::iota(parts.patches.order.begin(), parts.patches.order.end(), 0);
    parts.patches.begin.resize(parts.points.size() + 1);
    std::iota(parts.patches.begin.begin(), parts.patches.begin.end(), 0);
  }
  ShapeRows rows() const { return rows_at(parts.nodal_rows, at); }
  Response response(bool touches) const {
    return linear_response(stiff_body(parts, touches), parts.cloud.conditions, rows());
  }
};

TEST(LinearResponse, IsWhatTheSolverAnswersToASmallForce) {
  Parts box(true);
  const Response response = box.response(false);
  EXPECT_FALSE(response.free);
  EXPECT_LT((response.compliance - response.compliance.transpose()).norm(), 1e-9 * response.compliance.norm());
  const auto pushed = static_cast<Eigen::Index>(box.parts.cloud.original[171]);
  box.model.conditions.force = Points::Zero(box.model.cloud.positions.rows(), 3);
  box.model.conditions.force(pushed, 0) = 1e-5;  // N
  const SolveResult result = solve(box.model, {.shape = {.basis = Basis::linear},
                                               .volumetric = Volumetric::pointwise,
                                               .integration = Integration::plain,
                                               .tolerance = 1e-5});
  ASSERT_TRUE(result.failure.empty()) << result.failure;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto node = box.parts.cloud.original[static_cast<std::size_t>(box.at[static_cast<std::size_t>(i)])];
    const Eigen::Vector3d moved = result.solution.displacement.row(node);
    const Eigen::Vector3d expected = 10 * response.compliance.block<3, 1>(3 * i, 3);  // 10 µN
    EXPECT_LT((moved - expected).norm(), 0.03 * response.compliance(3, 3) * 10) << i;
  }
}

TEST(StiffBody, HasTheStiffnessOfItsMaterialToEvenStrains) {
  const Parts box(false);
  const Material& material = box.model.materials.at(1);
  const Eigen::MatrixXd stiffness = stiff_body(box.parts, false).stiffness;
  Eigen::VectorXd stretched = Eigen::VectorXd::Zero(stiffness.rows()), sheared = stretched;
  for (Eigen::Index a = 0; a < box.parts.cloud.positions.rows(); ++a) {
    stretched[3 * a + 2] = sheared[3 * a] = box.parts.cloud.positions(a, 2);
  }
  const double volume = std::pow(model_side, 3), shear = shear_modulus(material);
  EXPECT_NEAR(stretched.dot(stiffness * stretched) / volume / (bulk_modulus(material) + 4 * shear / 3), 1, 1e-6);
  EXPECT_NEAR(sheared.dot(stiffness * sheared) / volume / shear, 1, 1e-6);
}

TEST(LinearResponse, InASkullHardlyMovesTheSurfaceAlongItsNormal) {
  Parts box(false);
  Eigen::Index node = 0;
  const Eigen::RowVector3d middle_of_face(0, model_side / 2, model_side / 2);
  (box.parts.cloud.positions.rowwise() - middle_of_face).rowwise().norm().minCoeff(&node);
  box.at = {static_cast<std::int32_t>(node)};
  const Eigen::MatrixXd compliance = box.response(true).compliance;
  EXPECT_LT(compliance(0, 0), 0.1 * compliance(1, 1));
}

TEST(LinearResponse, OfAFreeBodyMovesItNotAsAWhole) {
  const Parts box(false);
  const Response response = box.response(false);
  EXPECT_TRUE(response.free);
  EXPECT_EQ(response.rigid.cols(), 6);
  EXPECT_GT(response.compliance.diagonal().minCoeff(), 0);
  const Parts held(true);
  EXPECT_LT(response.compliance(8, 8), 2 * held.response(false).compliance(8, 8));
}

TEST(LinearResponse, InASkullIsThatOfAFreeBodyWhereMoreOfTheSurfaceIsMeasured) {
  Parts box(false);
  EXPECT_FALSE(box.response(true).free);
  const Response free = box.response(false);
  const std::vector<std::int32_t> surface = surface_nodes(box.parts.cloud);
  Conditions& conditions = box.parts.cloud.conditions;
  Measurement& measured = conditions.measured.emplace();
  measured.spread.resize(static_cast<Eigen::Index>(box.parts.cloud.size()), static_cast<Eigen::Index>(surface.size()));
  for (const std::int32_t a : surface) {
    if (box.parts.cloud.positions(a, 2) > 1e-9) {
      conditions.displacement.row(a).setZero();
      measured.spread.insert(a, measured.spread.nonZeros()) = 1;
    }
  }
  const Response touching = box.response(true);
  EXPECT_TRUE(touching.free);
  EXPECT_EQ(touching.rigid.cols(), 6);
  EXPECT_EQ(touching.compliance, free.compliance);
}

TEST(CarriedMotion, TakesTheBodyAlongAsAWhole) {
  Parts box(false);
  Measurement& measured = box.parts.cloud.conditions.measured.emplace();
  const auto nodes = static_cast<Eigen::Index>(box.parts.cloud.size());
  measured.spread.resize(nodes, 4);
  for (const Eigen::Index a : {24, 30, 200, 310}) {
    measured.spread.insert(a, measured.spread.nonZeros()) = 1;
  }
  const Carried carried =
      carried_motion(stiff_body(box.parts, false), box.parts.cloud.conditions, box.parts.nodal_rows, box.rows());
  ASSERT_EQ(carried.nodes, (std::vector<Eigen::Index>{24, 30, 200, 310}));
  const Eigen::MatrixXd opening =
      rigid_motions(box.parts.cloud.positions(carried.nodes, Eigen::all), box.model.cloud.positions);
  const Points places = box.parts.cloud.positions(box.at, Eigen::all);
  const Eigen::MatrixXd expected = rigid_motions(places, box.model.cloud.positions);
  EXPECT_LT((carried.motion * opening - expected).norm(), 0.02 * expected.norm());
}

TEST(CarriedMotion, IsAtMeasuredNodesWhatTheyWereGiven) {
  Parts box(true);
  Measurement& measured = box.parts.cloud.conditions.measured.emplace();
  measured.spread.resize(static_cast<Eigen::Index>(box.parts.cloud.size()), 3);
  for (const std::int32_t a : box.at) {
    measured.spread.insert(a, measured.spread.nonZeros()) = 1;
  }
  const Carried carried =
      carried_motion(stiff_body(box.parts, false), box.parts.cloud.conditions, box.parts.nodal_rows, box.rows());
  EXPECT_LT((carried.motion - Eigen::MatrixXd::Identity(9, 9)).cwiseAbs().maxCoeff(), 0.03);
}

}  // namespace brainshift::solve::response_test
