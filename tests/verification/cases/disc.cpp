// SPDX-License-Identifier: GPL-3.0-or-later
//
// A disc pressed into a body of revolution, with nodes on the disc's rim, finer there: the load of a craniotomy, whose
// patch must act as wide as it is.
#include <cmath>

#include "tests/unit/solve/all_free.hpp"
#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::verification::disc_cases {

namespace {

/// Lengths in mm; those of references/fe/disc.py.
struct Body {
  double radius, height, disc, depth, poisson_ratio;
};

/// The cloud about the disc's rim.
struct Fineness {
  double least_distance, at_rim, reach, cells_reach;
};

solve::Model pressed(const Body& body, const Fineness& fineness) {
  const Grading rim{{{body.disc, body.height}}, fineness.at_rim, fineness.reach};
  solve::Model model;
  model.cloud = cylinder_cloud(body.radius, body.height, fineness.least_distance, 4, rim);
  model.boundary = cylinder_surface(body.radius, body.height);
  model.cells = cells_over(*model.boundary, model.cloud.size(), 0.75, refinement_about(rim, fineness.cells_reach));
  model.conditions = test::all_free(model.cloud);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    if (x[2] == 0) {
      model.conditions.displacement.row(a).setZero();
    } else if (x[2] == body.height && x.head<2>().norm() < body.disc + 1e-6) {
      model.conditions.displacement.row(a) << 0, 0, -body.depth;
    }
  }
  model.materials[1] = {3000, body.poisson_ratio, 1000};
  return model;
}

struct Bounds {
  double force, percentile95;  ///< %
};

/// In per cent of the force, and of the depth. Linear shape functions are told for comparison.
Outcome compare(const std::string& name, const Body& body, const Fineness& fineness, const Bounds& bounds, bool small) {
  const Reference reference = read_reference(name, "");
  const solve::Model model = pressed(body, fineness);
  Outcome outcome;
  const auto add = [&](const std::string& basis_name, Basis basis, bool bounded) {
    solve::SolveOptions options = steady_options();
    options.shape.basis = basis;
    const solve::SolveResult result = solved(model, options);
    const Differences apart = differences(result.solution, reference.positions, reference.displacement);
    const double force = std::abs(result.history.back().reaction[2]) / reference.converged_force - 1;
    const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
    const auto figure = [&](const std::string& what, double ours, std::optional<double> most) {
      const std::string of = std::to_string(model.cloud.size()) + " nodes, " + basis_name + ": ";
      const std::optional<double> bound = bounded ? most : std::nullopt;
      outcome.figures.push_back({of + what, "", 100 * ours, "%", bound, {}, reference.error, seconds});
    };
    figure("force", std::abs(force), bounds.force);
    figure("95 %", apart.percentile95 / body.depth, bounds.percentile95);
    figure("mean", apart.mean / body.depth, {});
    figure("largest difference", apart.largest / body.depth, {});
  };
  add("MMLS", Basis::modified_quadratic, true);
  if (!small) {
    add("linear MLS", Basis::linear, false);
  }
  return outcome;
}

}  // namespace

Outcome disc_cylinder(bool small) {
  const Body body{.radius = 20, .height = 30, .disc = 10, .depth = 4, .poisson_ratio = 0.32};
  return compare("disc_cylinder", body, {4.5, 0.35, 10, 1.5}, {4, 3}, small);
}

Outcome disc_slab(bool small) {
  const Body body{.radius = 30, .height = 13, .disc = 11.6, .depth = 1.5, .poisson_ratio = 0.13};
  return compare("disc_slab", body, {4.85, 0.4, 13, 4}, {4, 3}, small);
}

}  // namespace brainshift::verification::disc_cases
