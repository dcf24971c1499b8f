// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the discretisation: order of convergence on a manufactured solution, linear patch test, critical step.
#include <algorithm>
#include <cmath>

#include "solve/force/largest_eigenvalue.hpp"
#include "solve/force/stiffness_bound.hpp"
#include "solve/material/material_table.hpp"
#include "solve/output/field_difference.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/chapter_critical_step.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::verification::convergence_cases {

namespace {

constexpr double side = 40, amplitude = 1e-3;  // mm
const double wave = std::acos(-1.0) / side;

/// A smooth displacement with shear and volume change, linear elasticity.
Eigen::Vector3d swirl(const Eigen::Vector3d& x) {
  return amplitude * Eigen::Vector3d(std::sin(wave * x[1]), std::sin(wave * x[2]), std::sin(wave * x[0]));
}
Eigen::Vector3d squeeze(const Eigen::Vector3d& x) {
  const Eigen::Array3d s = (wave * x).array().sin(), c = (wave * x).array().cos();
  return amplitude * Eigen::Vector3d(s[0] * c[1] * c[2], c[0] * s[1] * c[2], c[0] * c[1] * s[2]);
}

/// L2 norm of the error over that of the solution, at random points.
double manufactured_error(Basis basis, double least_distance, double& seconds) {
  const solve::Material material = {.poisson_ratio = 0.3, .law = solve::Law::linear_elastic};
  const double shear = solve::shear_modulus(material);
  const double wave_modulus = solve::bulk_modulus(material) + 4 * shear / 3;
  solve::Model model;
  model.cloud = box_cloud(Eigen::Vector3d::Constant(side), least_distance, 5);
  model.conditions = test::all_free(model.cloud);
  const int cells = static_cast<int>(std::round(side / (1.15 * least_distance)));
  model.cells = test::box_cells(cells, side);
  model.materials[1] = material;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.on_surface[static_cast<std::size_t>(a)] != 0) {
      const Eigen::Vector3d x = model.cloud.positions.row(a);
      model.conditions.displacement.row(a) = swirl(x) + squeeze(x);
    }
  }
  // −div σ: µk² of a field without divergence, (λ + 2µ) 3k² of a gradient's
  model.body_force = [=](const Eigen::Vector3d& x, std::int32_t) -> Eigen::Vector3d {
    return 1e-6 * wave * wave * (shear * swirl(x) + 3 * wave_modulus * squeeze(x));
  };
  solve::SolveOptions options;
  options.shape.basis = basis;
  options.tolerance = 1e-7;
  const solve::SolveResult result = solved(model, options);
  seconds += result.measures.seconds_setup + result.measures.seconds_stepping;
  const Points points = test::random_points(2000, side, 11);
  Points exact(points.rows(), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    exact.row(i) = swirl(points.row(i)) + squeeze(points.row(i));
  }
  return (displacement_at(result.solution, points) - exact).norm() / exact.norm();
}

/// Slope of log y over log x by least squares.
double order(const Series& series) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(series.x.size());
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const double x = std::log(series.x[i]), y = std::log(series.y[i]);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace

Outcome manufactured(bool small) {
  const std::vector<double> spacings = small ? std::vector<double>{8, 5.5} : std::vector<double>{8, 5.6, 4, 2.8};
  Outcome outcome;
  Plot plot{"convergence",
            "manufactured solution on irregular clouds",
            "least distance of nodes, mm",
            "L2 error of the displacement / its norm",
            {},
            pipelines::Scale::log_log};
  for (const auto& [name, basis, least] : {std::tuple{"linear basis", Basis::linear, small ? 1.3 : 1.8},
                                           {"quadratic basis, MMLS", Basis::modified_quadratic, small ? 1.8 : 2.3}}) {
    Series series{name, {}, {}};
    double seconds = 0;
    for (const double spacing : spacings) {
      series.x.push_back(spacing);
      series.y.push_back(manufactured_error(basis, spacing, seconds));
    }
    outcome.figures.push_back(
        {std::string("L2 order of the displacement, ") + name, "", order(series), "", {}, least, "analytic", seconds});
    outcome.figures.push_back({std::string("L2 error of the finest cloud, ") + name,
                               "",
                               100 * series.y.back(),
                               "%",
                               {},
                               {},
                               "analytic",
                               seconds});
    plot.series.push_back(series);
  }
  outcome.plots.push_back(plot);
  return outcome;
}

namespace {

constexpr double strain = 0.02;

/// Largest departure of the inner nodes from a linear displacement imposed on the surface, over strain × spacing.
double patch_error(solve::Model model, Basis basis, solve::Integration integration, int points_per_cell,
                   double& seconds) {
  Eigen::Matrix3d slope;
  slope << 0.9, 0.3, -0.2, 0.1, -0.6, 0.4, -0.3, 0.2, 0.5;
  slope *= strain / slope.norm();
  Points linear(model.cloud.positions.rows(), 3);
  for (Eigen::Index a = 0; a < linear.rows(); ++a) {
    linear.row(a) = slope * model.cloud.positions.row(a).transpose();
    if (model.cloud.on_surface[static_cast<std::size_t>(a)] != 0) {
      model.conditions.displacement.row(a) = linear.row(a);
    }
  }
  solve::SolveOptions options;
  options.shape.basis = basis;
  options.integration = integration;
  options.consistency_defect = 1e-10;
  options.points_per_cell = points_per_cell;
  options.tolerance = 1e-11;
  const solve::SolveResult result = solved(model, options);
  seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
  double spacing = 0;
  for (const double s : model.cloud.spacing) {
    spacing += s / static_cast<double>(model.cloud.size());
  }
  return (result.solution.displacement - linear).rowwise().norm().maxCoeff() / (strain * spacing);
}

}  // namespace

Outcome patch_test(bool small) {
  const solve::Model cylinder = cylinder_model(small ? 14 : 9, 0.75, 0.49, {0, 0, 0});
  const int n = small ? 6 : 9;
  solve::Model box;
  box.cloud = test::irregular_box(n, 50);
  box.conditions = test::all_free(box.cloud);
  box.cells = test::box_tetrahedra(box.cloud, n);
  box.materials[1] = cylinder.materials.at(1);
  Outcome outcome;
  for (const auto& [basis_name, basis] :
       {std::pair{"linear", Basis::linear}, std::pair{"MMLS", Basis::modified_quadratic}}) {
    for (const auto& [how, integration] :
         {std::pair{"plain", solve::Integration::plain}, std::pair{"consistent", solve::Integration::consistent}}) {
      const std::optional<double> most =
          integration == solve::Integration::consistent ? std::optional(1e-8) : std::nullopt;
      for (const auto& [cells, model, points] :
           {std::tuple<const char*, const solve::Model*, int>{"conforming tetrahedra, ", &box, 4},
            {"non-conforming hexahedra, ", &cylinder, 8}}) {
        double seconds = 0;
        const double error = patch_error(*model, basis, integration, points, seconds);
        outcome.figures.push_back(
            {std::string(cells) + basis_name + ", " + how + ": displacement error / (strain × spacing)",
             "",
             error,
             "",
             most,
             {},
             "analytic",
             seconds});
      }
    }
  }
  return outcome;
}

namespace {

struct StepRatios {
  double ours, bound, chapter;  ///< estimate / true critical step
};

StepRatios step_ratios(double poisson_ratio, Basis basis, int points_per_cell, double nodes_per_patch, unsigned seed) {
  const solve::Material material = {3000, poisson_ratio, 1000};
  const NodeCloud cloud = box_cloud(Eigen::Vector3d::Constant(side), 6, seed);
  const BackgroundCells cells = test::box_cells(6, side);
  const solve::IntegrationPoints points = solve::integration_points(cells, points_per_cell, nullptr, {1});
  const solve::ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = basis});
  const solve::ShapeRows rows = shape.evaluate(points.positions, true);
  const std::vector<std::int32_t> row(points.size(), 0);
  const std::vector<double> share(points.size(),
                                  static_cast<double>(cloud.size()) / static_cast<double>(points.size()));
  const solve::PointBlocks blocks = solve::point_blocks(
      points, rows, row, cloud.size(), solve::pressure_patches(points.positions, share, row, nodes_per_patch));
  const solve::PointLaws laws{{solve::elastic_law(material)}};
  const std::vector<double> mass =
      solve::chapter_mass(blocks, std::vector<double>{solve::density_per_cubic_millimetre(material)});
  const double exact = 2 / std::sqrt(solve::largest_eigenvalue(blocks, laws, mass, 300));
  solve::ForceScratch scratch(blocks, laws);
  solve::NodalVectors rest(4 * cloud.size(), 0.0), force(rest);
  solve::internal_force(blocks, laws, rest, scratch, force);
  const std::vector<double> stiffness = solve::stiffness_bound(blocks, laws, scratch);
  const double bound = solve::critical_step(stiffness, mass);
  return {bound / std::sqrt(solve::bound_tightness(blocks, laws, stiffness, mass)) / exact, bound / exact,
          solve::chapter_critical_step(blocks, std::vector<double>{solve::wave_speed(material)}) / exact};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

Outcome step_estimate(bool small) {
  std::vector<double> ours, bound, chapter;
  for (unsigned seed = 1; seed <= (small ? 2U : 8U); ++seed) {
    for (const double nu : {0.3, 0.49, 0.499}) {
      for (const Basis basis : {Basis::linear, Basis::modified_quadratic}) {
        for (const auto& [points, patch] : {std::pair{1, 0.0}, std::pair{8, 0.0}, std::pair{8, 8.0}}) {
          const StepRatios ratios = step_ratios(nu, basis, points, patch, seed);
          ours.push_back(ratios.ours);
          bound.push_back(ratios.bound);
          chapter.push_back(ratios.chapter);
        }
      }
    }
  }
  const std::string reference = "power iteration, 300 steps, " + std::to_string(ours.size()) + " random clouds";
  return {{{"step estimate / true critical step: largest",
            "conservative",
            *std::max_element(ours.begin(), ours.end()),
            "",
            1,
            {},
            reference},
           {"median", "", median(ours), "", {}, 0.5, reference},
           {"smallest", "", *std::min_element(ours.begin(), ours.end()), "", {}, {}, reference},
           {"rigorous bound without power iteration: largest",
            "conservative",
            *std::max_element(bound.begin(), bound.end()),
            "",
            1,
            {},
            reference},
           {"rigorous bound without power iteration: median", "", median(bound), "", {}, {}, reference},
           {"Wittek et al., eq. 25: largest",
            "conservative",
            *std::max_element(chapter.begin(), chapter.end()),
            "",
            1,
            {},
            reference},
           {"Wittek et al., eq. 25: median", "", median(chapter), "", {}, {}, reference}},
          {}};
}

}  // namespace brainshift::verification::convergence_cases
