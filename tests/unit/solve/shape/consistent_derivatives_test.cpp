// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/shape/consistent_derivatives.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "solve/quadrature/cell_boundary.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::consistent_derivatives_test {

constexpr double side = model_side;
constexpr double strain_size = 0.01;
const Eigen::Matrix3d strain{{0.01, 0.004, 0}, {0.004, -0.006, 0.002}, {0, 0.002, -0.004}};
const Eigen::Matrix3d planar_strain{{0.01, 0.004, 0}, {0.004, -0.006, 0}, {0, 0, 0}};

/// A grid that sticks out of the box (0, side)³ and goes with no node; its cells are cut at the box.
BackgroundCells cut_cells() {
  constexpr int n = 5;
  constexpr double pitch = side / 4.3, start = -0.4 * pitch;
  BackgroundCells cells = test::box_cells(n, n * pitch);
  cells.vertices.array() += start;
  cells.inside_fraction.clear();
  for (int cell = 0; cell < n * n * n; ++cell) {
    const Eigen::Array3d corner = start + pitch * Eigen::Array3d(cell % n, cell / n % n, cell / (n * n));
    InsideOctants octants{};
    double inside = 0;
    for (int o = 0; o < 8; ++o) {
      const Eigen::Array3d low = corner + pitch / 2 * Eigen::Array3d(o & 1, o / 2 & 1, o / 4);
      const Eigen::Array3d from = low.max(0.0), to = (low + pitch / 2).min(side);
      octants.volume[o] = (to - from).max(0.0).prod();
      Eigen::Map<Eigen::Array3d>(octants.centroid[o]) = (from + to) / 2;
      inside += octants.volume[o];
    }
    const double fraction = inside / (pitch * pitch * pitch);
    cells.cut_index.push_back(fraction < 1 - 1e-12 ? static_cast<std::int32_t>(cells.cut_parts.size()) : -1);
    if (cells.cut_index.back() >= 0) {
      cells.cut_parts.push_back(octants);
    }
    cells.inside_fraction.push_back(std::min(fraction, 1.0));
  }
  return cells;
}

Model planar_model() {
  Model model;
  model.plane = Plane::strain;
  model.cloud = test::irregular_rectangle(7, 6, side, 50);
  model.conditions = test::all_free(model.cloud);
  model.cells = test::rectangle_cells(5, 4, side, 50);
  model.materials[1] = {3000, 0.49, 1000};
  return model;
}

/// Bodies whose cells do not conform to the nodes.
struct Scene {
  std::string name;
  Model model;
  Eigen::Matrix3d strain;
};

const std::vector<Scene> scenes = {{"coarser", box_model(test::box_cells(4, side), 6), strain},
                                   {"cut", box_model(cut_cells(), 6), strain},
                                   {"plane", planar_model(), planar_strain}};

/// What the correction works on, and the result.
struct Corrected {
  IntegrationPoints points;
  ShapeRows before, after;
  ConsistencyMeasures done;

  Corrected(const Model& model, Basis basis, double tolerance)
      : points(integration_points(model.cells, model.plane == Plane::none ? 8 : 4, nullptr, {1})) {
    const NodeCloud& cloud = model.cloud;
    const ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = basis, .planar = model.plane != Plane::none});
    before = after = shape.evaluate(points.positions, true);
    std::vector<std::int32_t> surface;
    for (std::size_t a = 0; a < cloud.size(); ++a) {
      if (cloud.on_surface[a] != 0) {
        surface.push_back(static_cast<std::int32_t>(a));
      }
    }
    done = make_derivatives_consistent(cloud.positions, surface, shape.evaluate(cloud.positions, false), points.volume,
                                       tolerance, after);
  }
};

/// Largest |Σ_a B_a| h and |Σ_a B_a ⊗ X_a − 1|, X_a from the point.
double completeness(const ShapeRows& rows, const Model& model, const Points& points) {
  Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  one(2, 2) = model.plane == Plane::none ? 1 : 0;
  double worst = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d gradient = -one;
    for (auto k = static_cast<std::size_t>(rows.begin[i]); k < static_cast<std::size_t>(rows.begin[i + 1]); ++k) {
      const Eigen::Map<const Eigen::Vector3d> b(&rows.derivative[3 * k]);
      sum += b;
      gradient += (model.cloud.positions.row(rows.node[k]) - points.row(static_cast<Eigen::Index>(i))).transpose() *
                  b.transpose();
    }
    worst = std::max({worst, model.cloud.spacing[0] * sum.norm(), gradient.norm()});
  }
  return worst;
}

TEST(ConsistentDerivatives, KeepReproducingLinearFields) {
  for (const Scene& scene : scenes) {
    const Corrected corrected(scene.model, Basis::linear, 1e-10);
    EXPECT_LE(completeness(corrected.after, scene.model, corrected.points.positions), 1e-12) << scene.name;
  }
}

TEST(ConsistentDerivatives, AreChangedLittleUntilTheDefectIsBelowTheTolerance) {
  for (const Scene& scene : scenes) {
    for (const double tolerance : {1e-4, 1e-10}) {
      const Corrected corrected(scene.model, Basis::modified_quadratic, tolerance);
      EXPECT_GE(corrected.done.defect_before, 1e-3) << scene.name;
      EXPECT_LE(corrected.done.defect_after, 1.01 * tolerance) << scene.name;
      EXPECT_GT(corrected.done.iterations, 0);
      const Eigen::Map<const Eigen::VectorXd> before(corrected.before.derivative.data(),
                                                     static_cast<Eigen::Index>(corrected.before.derivative.size()));
      const Eigen::Map<const Eigen::VectorXd> after(corrected.after.derivative.data(), before.size());
      RecordProperty(scene.name + "_change", std::to_string((after - before).norm() / before.norm()));
      EXPECT_LE((after - before).norm(), 0.2 * before.norm()) << scene.name;
    }
  }
}

TEST(ConsistentDerivatives, InThePlaneStayThere) {
  const Corrected corrected(planar_model(), Basis::linear, 1e-10);
  for (std::size_t i = 2; i < corrected.after.derivative.size(); i += 3) {
    ASSERT_EQ(corrected.after.derivative[i], 0);
  }
}

TEST(ConsistentDerivatives, NeedToKnowTheSurface) {
  Model model = planar_model();
  std::fill(model.cloud.on_surface.begin(), model.cloud.on_surface.end(), std::uint8_t{0});
  EXPECT_THROW(Corrected(model, Basis::linear, 1e-10), std::invalid_argument);
}

using Case = std::tuple<std::size_t, Basis>;
class NonConforming : public testing::TestWithParam<Case> {};

std::string name_of_case(const testing::TestParamInfo<Case>& tested) {
  return scenes[std::get<0>(tested.param)].name +
         (std::get<1>(tested.param) == Basis::linear ? "_linear" : "_modified");
}

INSTANTIATE_TEST_SUITE_P(Cells, NonConforming,
                         testing::Combine(testing::Values(0u, 1u, 2u),
                                          testing::Values(Basis::linear, Basis::modified_quadratic)),
                         name_of_case);

TEST_P(NonConforming, PassThePatchTestThatPlainIntegrationFails) {
  const Scene& scene = scenes[std::get<0>(GetParam())];
  SolveOptions options;
  options.shape.basis = std::get<1>(GetParam());
  options.points_per_cell = scene.model.plane == Plane::none ? 8 : 4;
  options.load_steps = 100;
  options.tolerance = 1e-3;
  options.integration = Integration::plain;
  const double imposed = strain_size * side;
  const double plain = difference_from(patch_test(scene.model, options, scene.strain).solution, scene.strain) / imposed;
  options.tolerance = 1e-10;
  options.integration = Integration::consistent;
  options.consistency_defect = 1e-10;
  const SolveResult result = patch_test(scene.model, options, scene.strain);
  ASSERT_TRUE(result.measures.converged) << result.failure;
  EXPECT_GT(result.measures.consistency_iterations, 0);
  const double consistent = difference_from(result.solution, scene.strain) / imposed;
  std::ostringstream figures;
  figures << plain << " plain, " << consistent << " consistent";
  RecordProperty("error", figures.str());
  EXPECT_LE(consistent, 1e-8);
  EXPECT_GE(plain, 5e-3);
}

/// A cube between frictionless plates, its sides free, in cells that do not go with its nodes.
struct FreeSides : testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Cells, FreeSides, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "cut" : "coarser"; });

TEST_P(FreeSides, CarryNoForceWhereTheBoundaryIsKnown) {
  constexpr double stretch = 0.7;
  Model model = uniaxial(stretch);
  const double lateral = uniaxial_answer(model.materials.at(1), stretch).second;
  const Eigen::Matrix3d answer = Eigen::Vector3d(lateral - 1, lateral - 1, stretch - 1).asDiagonal();
  const Surface boundary = cell_boundary(model.cells);
  model.cells = GetParam() ? cut_cells() : test::box_cells(4, side);
  SolveOptions options;
  options.points_per_cell = 8;
  options.load_steps = 200;
  options.tolerance = 1e-7;
  const auto error = [&](double defect) {
    options.consistency_defect = defect;
    const SolveResult result = solve(model, options);
    EXPECT_TRUE(result.measures.converged) << result.failure;
    return difference_from(result.solution, answer) / ((1 - stretch) * side);
  };
  model.boundary = boundary;
  const double fine = error(1e-7), by_default = error(SolveOptions().consistency_defect);
  model.boundary.reset();
  model.cells.inside_fraction.back() = std::min(model.cells.inside_fraction.back(), 1 - 1e-12);  // not that of cells
  const double unknown = error(1e-7);
  RecordProperty("error", std::to_string(fine) + ", " + std::to_string(by_default) + " by default, " +
                              std::to_string(unknown) + " without");
  EXPECT_LE(fine, 1e-5);
  EXPECT_LE(by_default, 1e-4);
  EXPECT_GE(unknown, 10 * by_default);
}

}  // namespace brainshift::solve::consistent_derivatives_test
