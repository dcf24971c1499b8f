// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wittek et al., section 6.1: 20 % compression and shear of a soft cylinder between bonded faces.
#include <cmath>

#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::verification::cylinder_cases {

namespace {

constexpr double least_distance = 5.4;        // mm: just under 5,000 nodes
constexpr double small_least_distance = 9.0;  // mm
constexpr double rim_fineness = 0.4;          // the solution is singular at the rims
constexpr double imposed = 20;                // mm

Differences differences_from(const Reference& reference, const solve::SolveResult& result) {
  return differences(result.solution, reference.positions, reference.displacement);
}

solve::Model cylinder(double poisson_ratio, const Eigen::RowVector3d& travel, double cells_per_node, bool small) {
  return cylinder_model(small ? small_least_distance : least_distance, cells_per_node, poisson_ratio, travel,
                        rim_fineness);
}

struct Bounds {
  double force, largest, percentile95, mean;  ///< %
};

double percent(double value, double of) {
  return 100 * std::abs(value) / of;
}

std::vector<Figure> displacement_figures(const solve::SolveResult& result, const Reference& reference,
                                         const Bounds& bounds, double seconds) {
  const Differences d = differences_from(reference, result);
  const std::string of = "displacement difference / imposed, ";
  return {{of + "largest", "3.5 %", percent(d.largest, imposed), "%", bounds.largest, {}, reference.error, seconds},
          {of + "95 %", "", percent(d.percentile95, imposed), "%", bounds.percentile95, {}, reference.error, seconds},
          {of + "mean", "", percent(d.mean, imposed), "%", bounds.mean, {}, reference.error, seconds},
          {"estimated error / difference, 95 %", "", result.measures.estimated_error_95.value_or(0) / d.percentile95,
           "", 5, 0.5, reference.error, seconds}};
}

Outcome compare(const std::string& name, double poisson_ratio, const Eigen::RowVector3d& travel, int axis,
                const Bounds& bounds, bool small) {
  const Reference reference = read_reference(name, name + "_force");
  const solve::Model model = cylinder(poisson_ratio, travel, 0.75, small);
  Outcome outcome;
  Series ours{"brainshift, MMLS, " + std::to_string(model.cloud.size()) + " nodes", {0}, {0}};
  const int loads = small ? 1 : 4;
  for (int load = 1; load <= loads; ++load) {
    solve::Model part = model;
    part.conditions.displacement *= static_cast<double>(load) / loads;
    const solve::SolveResult result = solved(part, steady_options());
    ours.x.push_back(imposed * load / loads);
    ours.y.push_back(std::abs(result.history.back().reaction[axis]));
    if (load == loads) {
      const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
      outcome.figures.push_back({"reaction force, " + std::to_string(model.cloud.size()) + " nodes",
                                 "5 %",
                                 percent(ours.y.back() - reference.converged_force, reference.converged_force),
                                 "%",
                                 bounds.force,
                                 {},
                                 reference.error,
                                 seconds});
      for (Figure& figure : displacement_figures(result, reference, bounds, seconds)) {
        outcome.figures.push_back(std::move(figure));
      }
    }
  }
  outcome.plots.push_back({name,
                           name + ": force against displacement",
                           "displacement, mm",
                           "force, N",
                           {{"CalculiX", reference.travel, reference.force}, ours}});
  return outcome;
}

}  // namespace

Outcome cylinder_compression(bool small) {
  return compare("cylinder_compression", 0.49, {0, 0, -imposed}, 2,
                 small ? Bounds{4, 9, 4, 1} : Bounds{1, 3.5, 1.5, 0.4}, small);
}

Outcome cylinder_shear(bool small) {
  return compare("cylinder_shear", 0.49, {imposed, 0, 0}, 0, small ? Bounds{4, 9, 4, 1} : Bounds{1.5, 3.5, 1.5, 0.4},
                 small);
}

Outcome cylinder_nearly_incompressible(bool small) {
  return compare("cylinder_compression_nu0499", 0.499, {0, 0, -imposed}, 2,
                 small ? Bounds{5, 9, 4, 1} : Bounds{1.5, 3.5, 1.5, 0.4}, small);
}

/// What each treatment of the volumetric term leaves, for the README beside: no bounds.
Outcome locking(bool small) {
  const Reference reference = read_reference("cylinder_compression", "cylinder_compression_force");
  struct Variant {
    std::string name;
    Basis basis;
    double cells_per_node;
    int points;
    double nodes_per_patch;  ///< 0: pointwise
    solve::Integration integration;
  };
  constexpr auto plain = solve::Integration::plain;
  const std::vector<Variant> variants = {
      {"linear, pointwise, 2 one-point cells a node", Basis::linear, 2, 1, 0, plain},
      {"linear, pointwise, 6 points a node", Basis::linear, 0.75, 8, 0, plain},
      {"MMLS, pointwise, 2 one-point cells a node", Basis::modified_quadratic, 2, 1, 0, plain},
      {"MMLS, pointwise, 6 points a node", Basis::modified_quadratic, 0.75, 8, 0, plain},
      {"linear, patches of 4 nodes", Basis::linear, 0.75, 8, 4, plain},
      {"linear, patches of 8 nodes", Basis::linear, 0.75, 8, 8, plain},
      {"MMLS, patches of 4 nodes", Basis::modified_quadratic, 0.75, 8, 4, plain},
      {"MMLS, patches of 8 nodes", Basis::modified_quadratic, 0.75, 8, 8, plain},
      {"MMLS, patches of 16 nodes", Basis::modified_quadratic, 0.75, 8, 16, plain},
      {"MMLS, patches of 8 nodes, 16 points a node", Basis::modified_quadratic, 2, 8, 8, plain},
      {"MMLS, patches of 8 nodes, consistent", Basis::modified_quadratic, 0.75, 8, 8, solve::Integration::consistent}};
  Outcome outcome;
  for (const Variant& variant : variants) {
    const solve::Model model = cylinder(0.49, {0, 0, -imposed}, variant.cells_per_node, small);
    solve::SolveOptions options;
    options.shape.basis = variant.basis;
    options.points_per_cell = variant.points;
    options.volumetric =
        variant.nodes_per_patch > 0 ? solve::Volumetric::mean_dilatation : solve::Volumetric::pointwise;
    options.nodes_per_patch = variant.nodes_per_patch > 0 ? variant.nodes_per_patch : options.nodes_per_patch;
    options.integration = variant.integration;
    const solve::SolveResult result = solve::solve(model, options);
    const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
    const Differences d = differences_from(reference, result);
    const double force = std::abs(result.history.back().reaction[2]);
    outcome.figures.push_back({variant.name + ": force",
                               "",
                               100 * (force / reference.converged_force - 1),
                               "%",
                               {},
                               {},
                               reference.error,
                               seconds});
    outcome.figures.push_back({variant.name + ": mean difference", "", d.mean, "mm", {}, {}, reference.error, seconds});
    if (small && outcome.figures.size() >= 4) {
      break;
    }
  }
  return outcome;
}

}  // namespace brainshift::verification::cylinder_cases
