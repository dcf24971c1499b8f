// SPDX-License-Identifier: GPL-3.0-or-later

// Homogeneous states are exact with the default options: on any cloud, in any cells, at large strains.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <ostream>

#include "discretise/discretise.hpp"
#include "segmentation/files/surface_file.hpp"
#include "solve/body/nodal_order.hpp"
#include "solve/force/internal_force.hpp"
#include "solve/run/completed.hpp"
#include "solve/run/prepare.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/clouds.hpp"

namespace brainshift::solve::homogeneous_test {

constexpr double side = model_side;

/// Conforming tetrahedra, 216 nodes.
Model cube() {
  Model model = box_model({}, 6);
  model.cells = test::box_tetrahedra(model.cloud, 6);
  return model;
}

/// Nodes 4 mm apart in the middle of the top and 18 mm far from it, some 390; hexahedra that do not conform.
Model graded_cube_in(double cells_a_node) {
  const Eigen::Vector3d fine(side / 2, side / 2, side);
  Model model = box_model({});
  model.cloud = verification::box_cloud(Eigen::Vector3d::Constant(side), 12, 3, [&](const Eigen::Vector3d& x) {
    return std::clamp((x - fine).norm() / 45, 0.3, 1.0);
  });
  model.boundary = test::box(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(side));
  model.cells = verification::cells_over(*model.boundary, model.cloud.size(), cells_a_node,
                                         discretise::Refinement{Points(fine.transpose()), 6, 0.3});
  return model;
}

Model graded_cube() {
  return graded_cube_in(0.75);
}

/// Of 4.6 points a node.
Model coarse_cells() {
  return graded_cube_in(0.4);
}

/// Of 1.2 points a node.
Model coarsest_cells() {
  return graded_cube_in(0.08);
}

/// Some 410 nodes in hexahedra that do not conform.
Model cylinder() {
  return verification::cylinder_model(12, 0.75, 0.49, Eigen::RowVector3d::Zero());
}

/// 600 nodes as discretise makes them; factor: of the spacing at the highest place.
Model brain(double factor) {
  Model model = box_model({});
  model.boundary = read_surface(BRAINSHIFT_REFERENCES "/brain_surface.vtp");
  discretise::DiscretiseOptions options;
  options.nodes = 600;
  if (factor < 1) {
    Eigen::Index highest = 0;
    model.boundary->vertices.col(2).maxCoeff(&highest);
    options.craniotomy = discretise::Refinement{Points(model.boundary->vertices.row(highest)), 20, factor};
  }
  const discretise::Discretisation made = discretise::discretise(*model.boundary, nullptr, options);
  model.cloud = made.cloud;
  model.cells = made.cells;
  return model;
}

Model even_brain() {
  return brain(1);
}

Model opened_brain() {
  return brain(0.4);
}

/// J over the integration points, of cells that are not split.
struct Jacobians {
  double smallest = 1e9, largest = -1e9;
  std::size_t points = 0;
};

Jacobians jacobians(const Model& model, const Solution& solution) {
  SolveOptions options;
  options.shape = solution.shape;
  SolveMeasures measures;
  const Prepared prepared = prepare(model, completed(options, model), {}, measures, {});
  const PointBlocks& points = prepared.body.points;
  ForceScratch scratch(points, prepared.body.laws);
  const Points parameters = parameters_from_displacement({solution.positions, solution.spacing, solution.shape},
                                                         solution.positions, solution.displacement);
  NodalVectors force(4 * model.cloud.size());
  internal_force(points, prepared.body.laws, in_body_order(parameters, prepared.body.original), scratch, force);
  Jacobians found;
  found.points = measures.integration_points;
  for (const Patch& patch : points.patches) {
    for (const Eigen::Matrix3d& gradient : gradients_of(points, patch, scratch)) {
      found.smallest = std::min(found.smallest, gradient.determinant());
      found.largest = std::max(found.largest, gradient.determinant());
    }
  }
  return found;
}

struct Bounds {
  double displacement;  ///< largest error, of the largest displacement that is imposed
  double strain;        ///< of J at any point, and of the largest stretch
};

/// Solves; every node must have gone where it is wanted, and F be the gradient at every point.
void expect_homogeneous(const Model& model, const Points& wanted, const Eigen::Matrix3d& gradient,
                        const SolveOptions& options, const Bounds& bounds) {
  const SolveResult result = solve(model, options);
  ASSERT_TRUE(result.measures.converged) << result.failure;
  const double imposed = wanted.rowwise().norm().maxCoeff();
  const double off = (result.solution.displacement - wanted).rowwise().norm().maxCoeff() / imposed;
  const double volume = gradient.determinant();
  const double stretch = Eigen::JacobiSVD<Eigen::Matrix3d>(gradient).singularValues()[0];
  const Jacobians found = jacobians(model, result.solution);
  testing::Message figures;
  figures << model.cloud.size() << " nodes, " << result.measures.integration_points << " points, fewest "
          << result.measures.fewest_points << ", pressed " << result.measures.pressed_share << ", "
          << result.measures.steps << " steps, took '" << result.measures.took << "'; off by " << off << " of the "
          << imposed << " mm imposed; J " << found.smallest - volume << " to " << found.largest - volume << " from "
          << volume << "; largest stretch " << result.measures.largest_stretch - stretch << " from " << stretch;
  testing::Test::RecordProperty("figures", figures.GetString());
  EXPECT_LE(off, bounds.displacement) << figures;
  EXPECT_GE(found.smallest, volume - bounds.strain) << figures;
  EXPECT_LE(found.largest, volume + bounds.strain) << figures;
  if (result.measures.integration_points == found.points) {
    EXPECT_NEAR(result.measures.smallest_jacobian, std::min(1.0, found.smallest), 1e-6) << figures;
  } else {
    EXPECT_NEAR(result.measures.smallest_jacobian, volume, bounds.strain) << "at other points; " << figures;
  }
  EXPECT_NEAR(result.measures.largest_stretch, std::max(1.0, stretch), bounds.strain) << figures;
}

/// So tight that the stop is not what is measured.
SolveOptions to_the_end() {
  SolveOptions options;
  options.tolerance = 1e-5;
  return options;
}

/// The surface moved by a gradient about the middle. Returns where that takes all nodes.
Points move_surface(const Eigen::Matrix3d& gradient, Model& model) {
  const Points& x = model.cloud.positions;
  Points wanted = (x.rowwise() - x.colwise().mean()) * (gradient - Eigen::Matrix3d::Identity()).transpose();
  model.conditions = test::all_free(model.cloud);
  for (const std::int32_t a : surface_nodes(model.cloud)) {
    model.conditions.displacement.row(a) = wanted.row(a);
  }
  return wanted;
}

void expect_affine(Model model, const Eigen::Matrix3d& gradient, const SolveOptions& options, const Bounds& bounds) {
  const Points wanted = move_surface(gradient, model);
  expect_homogeneous(model, wanted, gradient, options, bounds);
}

/// The node of the inside that is nearest to a place.
Eigen::Index inner_node(const NodeCloud& cloud, const Eigen::RowVector3d& place) {
  Eigen::VectorXd distance = (cloud.positions.rowwise() - place).rowwise().norm();
  for (const std::int32_t a : surface_nodes(cloud)) {
    distance[a] = 1e9;
  }
  Eigen::Index nearest = 0;
  distance.minCoeff(&nearest);
  return nearest;
}

/// Presses a body between plates without friction, its sides free. It stands on planes of symmetry where it has nodes
/// at x = 0 and y = 0, else two nodes of the inside keep it from sliding and turning.
void expect_pressed(Model model, double stretch, const Bounds& bounds) {
  const double lateral = uniaxial_answer(model.materials.at(1), stretch).second;
  const Eigen::Matrix3d gradient = Eigen::Vector3d(lateral, lateral, stretch).asDiagonal();
  const Points& x = model.cloud.positions;
  const Points wanted = x * (gradient - Eigen::Matrix3d::Identity());
  const double top = x.col(2).maxCoeff();
  model.conditions = test::all_free(model.cloud);
  Points& prescribed = model.conditions.displacement;
  for (Eigen::Index a = 0; a < x.rows(); ++a) {
    for (int axis = 0; axis < 3; ++axis) {
      if (x(a, axis) == 0 || (axis == 2 && x(a, axis) == top)) {
        prescribed(a, axis) = wanted(a, axis);
      }
    }
  }
  if (x.col(0).minCoeff() < 0) {
    const Eigen::Index middle = inner_node(model.cloud, {0, 0, top / 2});
    const Eigen::Index beside = inner_node(model.cloud, {0.7 * x.col(0).maxCoeff(), 0, top / 2});
    prescribed.row(middle).head<2>() = wanted.row(middle).head<2>();
    prescribed(beside, 1) = wanted(beside, 1);
  }
  expect_homogeneous(model, wanted, gradient, to_the_end(), bounds);
}

/// Of these three principal stretches, across the axes.
Eigen::Matrix3d oblique(const Eigen::Vector3d& stretches) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  return turn * stretches.asDiagonal() * turn.transpose();
}

struct Filled {
  const char* name;
  Model (*model)();
};

void PrintTo(const Filled& body, std::ostream* out) {
  *out << body.name;
}

std::string name_of_body(const testing::TestParamInfo<Filled>& tested) {
  return tested.param.name;
}

struct Surrounded : testing::TestWithParam<Filled> {};

INSTANTIATE_TEST_SUITE_P(Bodies, Surrounded,
                         testing::Values(Filled{"cube", cube}, Filled{"graded_cube", graded_cube},
                                         Filled{"cylinder", cylinder}, Filled{"brain", even_brain},
                                         Filled{"opened_brain", opened_brain}),
                         name_of_body);

/// Pressed to 0.6 in one direction and pulled to 1.4 in another, with 2 % of the volume lost.
TEST_P(Surrounded, FollowsAnAffineDisplacementOfTheSurfaceAtFortyPercent) {
  expect_affine(GetParam().model(), oblique({0.6, 1.4, 0.98 / (0.6 * 1.4)}), to_the_end(), {1e-4, 1e-4});
}

/// The start is the answer already: what still moves in single precision is rounding, and no slow motion.
TEST(SurroundedBody, IsAtRestAsSoonInSinglePrecision) {
  for (const double stretch : {0.8, 0.9, 1.2}) {
    Model model = box_model({}, 5);
    model.cells = test::box_tetrahedra(model.cloud, 5);
    move_surface(oblique({stretch, 1.1, 1 / (stretch * 1.1)}), model);
    SolveOptions options;
    options.start = Start::coarse;
    options.shape.basis = Basis::linear;
    options.precision = Precision::double_precision;
    const int steps = solve(model, options).measures.steps;
    options.precision = Precision::single_precision;
    const SolveMeasures single = solve(model, options).measures;
    EXPECT_EQ(single.steps, steps) << stretch;
    EXPECT_LE(single.error_bound, 1e-4) << stretch;
  }
}

struct Squeezed : testing::TestWithParam<Filled> {};

INSTANTIATE_TEST_SUITE_P(Bodies, Squeezed,
                         testing::Values(Filled{"graded_cube", graded_cube}, Filled{"coarse_cells", coarse_cells},
                                         Filled{"coarsest_cells", coarsest_cells}),
                         name_of_body);

/// At ν = 0.49 that is a pressure of eight shear moduli.
Eigen::Matrix3d squeeze() {
  return oblique(std::cbrt(0.84) * Eigen::Vector3d(0.95, 1.05, 1 / (0.95 * 1.05)));
}

TEST_P(Squeezed, LosesTheSixthOfItsVolumeThatIsPrescribedEverywhere) {
  expect_affine(GetParam().model(), squeeze(), {}, {0.01, 0.005});
}

/// Cells that are split as somebody asks, and have two points a node in places: it folds.
TEST(SqueezedBody, WithFewPointsANodeSaysThatItMayBeAllWrong) {
  Model model = coarse_cells();
  move_surface(squeeze(), model);
  SolveOptions options;
  options.integration_tolerance = 0.5;
  options.integration_depth = 1;
  EXPECT_EQ(solve(model, options).measures.pressed_share, 1);
}

struct BetweenPlates : testing::TestWithParam<Filled> {};

INSTANTIATE_TEST_SUITE_P(Bodies, BetweenPlates,
                         testing::Values(Filled{"cube", cube}, Filled{"graded_cube", graded_cube},
                                         Filled{"cylinder", cylinder}),
                         name_of_body);

TEST_P(BetweenPlates, KeepsItsSidesStraightAtThirtyPercent) {
  expect_pressed(GetParam().model(), 0.7, {1e-4, 3e-4});
}

TEST_P(BetweenPlates, KeepsItsSidesStraightAtFortyPercent) {
  expect_pressed(GetParam().model(), 0.6, {1e-4, 3e-4});
}

}  // namespace brainshift::solve::homogeneous_test
