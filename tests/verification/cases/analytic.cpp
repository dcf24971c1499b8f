// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cases with a solution on paper: homogeneous deformation of every law that has large strains, Timoshenko's cantilever,
// Lamé's hollow ball.
#include <algorithm>
#include <cmath>
#include <variant>

#include "solve/material/elastic_law.hpp"
#include "solve/material/named_materials.hpp"
#include "solve/shape/node_supports.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/material_cases.hpp"
#include "tests/unit/solve/move_surface.hpp"
#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::verification::analytic_cases {

namespace {

/// diag(stretch, ...) with the axes that are NaN stretched until they carry no stress: one unknown, by bisection.
Eigen::Matrix3d with_free_sides(const solve::Material& material, const Eigen::Vector3d& stretch) {
  double low = 0.2, high = 3;
  Eigen::Matrix3d gradient;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    gradient = stretch.unaryExpr([middle](double s) { return std::isnan(s) ? middle : s; }).asDiagonal();
    double stress = 0;
    for (int axis = 0; axis < 3; ++axis) {
      stress = std::isnan(stretch[axis]) ? solve::stress(solve::elastic_law(material), gradient)(axis, axis) : stress;
    }
    (stress < 0 ? low : high) = middle;
  }
  return gradient;
}

constexpr double side = 20;  // mm

/// A box of irregular nodes whose faces at 0 do not leave their planes; the others follow the stretches that are not
/// NaN.
solve::Model stretched_box(const solve::Material& material, const Eigen::Vector3d& stretch, double least_distance) {
  solve::Model model;
  model.cloud = box_cloud(Eigen::Vector3d::Constant(side), least_distance, 3);
  model.conditions = test::all_free(model.cloud);
  const int cells = static_cast<int>(std::round(0.75 * side / least_distance));
  model.cells = test::box_cells(cells, side);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    for (int axis = 0; axis < 3; ++axis) {
      if (model.cloud.positions(a, axis) == 0) {
        model.conditions.displacement(a, axis) = 0;
      } else if (model.cloud.positions(a, axis) == side && !std::isnan(stretch[axis])) {
        model.conditions.displacement(a, axis) = side * (stretch[axis] - 1);
      }
    }
  }
  model.materials[1] = material;
  return model;
}

Figure stretch_figure(const std::string& name, const solve::Material& material, const Eigen::Vector3d& stretch,
                      bool small) {
  const solve::SolveResult result = solved(stretched_box(material, stretch, small ? 5 : 2.5), steady_options());
  constexpr double per_square_millimetre = 1e-6;  // Pa to N/mm²
  const double exact = side * side * per_square_millimetre *
                       solve::stress(solve::elastic_law(material), with_free_sides(material, stretch))(0, 0);
  double force = 0;
  for (Eigen::Index a = 0; a < result.solution.positions.rows(); ++a) {
    force += result.solution.positions(a, 0) == side ? result.solution.reaction_force(a, 0) : 0;
  }
  return {name + ": force",
          "",
          100 * std::abs(force / exact - 1),
          "%",
          small ? 0.2 : 0.02,
          {},
          "analytic",
          result.measures.seconds_setup + result.measures.seconds_stepping};
}

Figure shear_figure(const std::string& name, const solve::Material& material, bool small) {
  constexpr double shear = 0.4;
  solve::Model model = stretched_box(material, Eigen::Vector3d::Constant(std::nan("")), small ? 5 : 2.5);
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Identity();
  gradient(0, 2) = shear;
  test::move_surface(model, gradient - Eigen::Matrix3d::Identity());
  const solve::SolveResult result = solved(model, steady_options());
  constexpr double joule = 1e-9;  // Pa mm³ to J
  const double exact = std::visit([&](const auto& law) { return law.isochoric_energy(solve::Deformation(gradient)); },
                                  solve::elastic_law(material));
  const double energy = 1e-3 * result.history.back().strain_energy;
  return {name + ": strain energy",
          "",
          100 * std::abs(energy / (exact * std::pow(side, 3) * joule) - 1),
          "%",
          0.02,
          {},
          "analytic",
          result.measures.seconds_setup + result.measures.seconds_stepping};
}

}  // namespace

Outcome homogeneous(bool small) {
  const double free = std::nan("");
  const solve::Material neo_hookean = *solve::named_material("brain");
  const solve::Material ogden = *solve::named_material("brain_ogden");
  Outcome outcome;
  for (const auto& [name, material] :
       {std::pair<std::string, const solve::Material&>{"neo-Hookean", neo_hookean}, {"Ogden", ogden}}) {
    outcome.figures.push_back(stretch_figure(name + ", uniaxial 1.3", material, {1.3, free, free}, small));
    outcome.figures.push_back(stretch_figure(name + ", uniaxial 0.7", material, {0.7, free, free}, small));
    outcome.figures.push_back(stretch_figure(name + ", equibiaxial 1.2", material, {1.2, 1.2, free}, small));
    outcome.figures.push_back(shear_figure(name + ", simple shear 0.4", material, small));
  }
  return outcome;
}

/// Timoshenko & Goodier, Theory of Elasticity, article 21: exact displacement at the held end, parabolic shear at the
/// other.
Outcome cantilever(bool small) {
  constexpr double length = 100, depth = 20, force = 6e-7;  // mm, mm, N/mm
  const solve::Material material = {.poisson_ratio = 0.3, .law = solve::Law::linear_elastic};
  const double youngs = 1e-6 * material.youngs_modulus, nu = material.poisson_ratio;  // N/mm²
  const double inertia = std::pow(depth, 3) / 12;
  const auto exact = [&](const Eigen::RowVector3d& at) {
    const double x = at[0], y = at[1] - depth / 2;
    return Eigen::RowVector3d(
        -force * y / (6 * youngs * inertia) * ((6 * length - 3 * x) * x + (2 + nu) * (y * y - depth * depth / 4)),
        force / (6 * youngs * inertia) *
            (3 * nu * y * y * (length - x) + (4 + 5 * nu) * depth * depth * x / 4 + (3 * length - x) * x * x),
        0);
  };
  solve::Model model;
  const double least = small ? 4 : 2;
  model.plane = solve::Plane::stress;
  model.cloud = rectangle_cloud(length, depth, least, 2);
  model.conditions = test::all_free(model.cloud);
  model.cells = test::rectangle_cells(static_cast<int>(length / least), static_cast<int>(depth / least), length, depth);
  model.materials[1] = material;
  model.conditions.force = Points::Zero(model.cloud.positions.rows(), 3);
  std::vector<std::pair<double, Eigen::Index>> end;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 0) == 0) {
      model.conditions.displacement.row(a) = exact(model.cloud.positions.row(a));
    } else if (model.cloud.positions(a, 0) == length) {
      end.emplace_back(model.cloud.positions(a, 1), a);
    }
  }
  std::sort(end.begin(), end.end());
  const auto sheared = [&](double y) {  // ∫ of the traction from 0 to y, N/mm
    const double s = y / depth;
    return force * s * s * (3 - 2 * s);
  };
  for (std::size_t i = 0; i < end.size(); ++i) {
    const double from = i == 0 ? 0 : (end[i - 1].first + end[i].first) / 2;
    const double to = i + 1 == end.size() ? depth : (end[i].first + end[i + 1].first) / 2;
    model.conditions.force(end[i].second, 1) = sheared(to) - sheared(from);
  }
  solve::SolveOptions options;
  options.points_per_cell = 4;
  options.tolerance = 1e-6;
  const solve::SolveResult result = solved(model, options);
  double largest = 0;
  for (Eigen::Index a = 0; a < result.solution.positions.rows(); ++a) {
    largest = std::max(largest, (result.solution.displacement.row(a) - exact(result.solution.positions.row(a))).norm());
  }
  const double tip = exact({length, depth / 2, 0})[1];
  return {{{"cantilever, plane stress, " + std::to_string(model.cloud.size()) + " nodes: largest difference / tip's",
            "",
            100 * largest / tip,
            "%",
            small ? 3 : 1,
            {},
            "analytic (Timoshenko)",
            result.measures.seconds_setup + result.measures.seconds_stepping}},
          {}};
}

namespace {

/// Hexahedra in r, polar angle and azimuth over an eighth of a hollow ball; those at the pole are wedges.
BackgroundCells hollow_ball_cells(double inner, double outer, int radial, int angular) {
  BackgroundCells cells = test::box_cells({radial, angular, angular}, Eigen::Vector3d::Constant(1));
  for (Eigen::Index v = 0; v < cells.vertices.rows(); ++v) {
    const double r = inner + cells.vertices(v, 0) * (outer - inner);
    const double polar = std::acos(0.0) * cells.vertices(v, 1), azimuth = std::acos(0.0) * cells.vertices(v, 2);
    cells.vertices.row(v) << r * std::sin(polar) * std::cos(azimuth), r * std::sin(polar) * std::sin(azimuth),
        r * std::cos(polar);
  }
  return cells;
}

}  // namespace

/// Lamé: u = A r + B / r², without stress at the outer radius; the inner one is widened.
Outcome pressurised_ball(bool small) {
  constexpr double inner = 10, outer = 20, widened = 0.01, poisson_ratio = 0.49;  // mm
  const solve::Material material = {.poisson_ratio = poisson_ratio, .law = solve::Law::linear_elastic};
  const double shear = solve::shear_modulus(material), bulk = solve::bulk_modulus(material);
  const double ratio = 4 * shear / (3 * bulk * std::pow(outer, 3));  // A / B
  const double b = widened / (ratio * inner + 1 / (inner * inner));
  const double pressure = 4 * shear * b * (1 / std::pow(inner, 3) - 1 / std::pow(outer, 3));
  solve::Model model;
  const double least = small ? 3.0 : 1.4;
  model.cloud = hollow_ball_cloud(inner, outer, least, 4);
  model.conditions = test::all_free(model.cloud);
  const int radial = static_cast<int>(std::round(10 / (1.2 * least)));
  model.cells = hollow_ball_cells(inner, outer, radial, 2 * radial);
  model.materials[1] = material;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(x.norm() - inner) < 1e-9) {
        model.conditions.displacement(a, axis) = widened * x[axis] / inner;
      } else if (std::abs(x[axis]) < 1e-9) {
        model.conditions.displacement(a, axis) = 0;
      }
    }
  }
  solve::SolveOptions options;
  options.tolerance = 1e-6;
  const solve::SolveResult result = solved(model, options);
  double largest = 0, mean = 0;
  for (Eigen::Index a = 0; a < result.solution.positions.rows(); ++a) {
    const Eigen::RowVector3d x = result.solution.positions.row(a);
    const double r = x.norm();
    const double off = (result.solution.displacement.row(a) - b * (ratio * r + 1 / (r * r)) * x / r).norm();
    largest = std::max(largest, off);
    mean += off / static_cast<double>(result.solution.positions.rows());
  }
  constexpr double millijoule = 1e-6;                                                        // Pa mm³ to mJ
  const double work = pressure * widened * std::acos(0.0) * inner * inner / 2 * millijoule;  // p u/2 over 4πa²/8
  const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
  const std::string name = "hollow ball, nu = 0.49, " + std::to_string(model.cloud.size()) + " nodes: ";
  return {
      {{name + "largest difference / imposed", "", 100 * largest / widened, "%", {}, {}, "analytic (Lamé)", seconds},
       {name + "mean difference / imposed",
        "",
        100 * mean / widened,
        "%",
        small ? 3 : 1,
        {},
        "analytic (Lamé)",
        seconds},
       {name + "pressure, by the strain energy",
        "",
        100 * std::abs(result.history.back().strain_energy / work - 1),
        "%",
        small ? 6 : 2,
        {},
        "analytic (Lamé)",
        seconds}},
      {}};
}

}  // namespace brainshift::verification::analytic_cases
