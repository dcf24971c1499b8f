// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wittek et al., figure 8: brain shift in the plane, triangles whose corners are the nodes, three Gauss points each;
// how far the displacements lie from those of τ = 0.001.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "segmentation/files/surface_file.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/reference.hpp"
#include "tests/verification/slice.hpp"

namespace brainshift::verification::adaptive_cases {

namespace {

constexpr double opening = 28, held_from = 112, pushed = 9;  // mm; the first two from the opening's centre

/// A coronal section through the opening of the brain case. Pushed in under the opening, held at the far side, free
/// elsewhere; nearly incompressible, plane strain.
solve::Model slice_model(double least_distance) {
  const Eigen::Vector3d centre(45.03, 10.48, 62.24), inward(-0.6411, 0.1735, -0.7476), right(1, 0, 0);
  const Points outline = section(read_surface(BRAINSHIFT_REFERENCES "/brain_surface.vtp"), centre, right, -inward);
  const double across = inward.normalized().dot(right);
  const Eigen::RowVector3d direction(across, -std::sqrt(1 - across * across), 0);
  solve::Model model;
  model.plane = solve::Plane::strain;
  model.cloud = cloud_in(outline, least_distance, 1);
  model.conditions = test::all_free(model.cloud);
  model.cells = triangles_in(outline, model.cloud.positions);
  model.materials[1] = {3000, 0.49, 1000};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double distance = model.cloud.positions.row(a).norm(), t = 1 - distance / opening;
    if (model.cloud.on_surface[static_cast<std::size_t>(a)] == 0) {
      continue;
    }
    if (t > 0) {
      model.conditions.displacement.row(a) = pushed * t * t * t * (10 - 15 * t + 6 * t * t) * direction;
    } else if (distance > held_from) {
      model.conditions.displacement.row(a).setZero();
    }
  }
  return model;
}

Differences apart(const solve::SolveResult& result, const solve::SolveResult& reference) {
  const Eigen::VectorXd norms = (result.solution.displacement - reference.solution.displacement).rowwise().norm();
  std::vector<double> sorted(norms.begin(), norms.end());
  std::sort(sorted.begin(), sorted.end());
  return {sorted.back(), sorted[sorted.size() * 95 / 100], norms.mean()};
}

/// What a curve is computed with.
struct Method {
  std::string name;
  Basis basis;
  solve::Volumetric volumetric;
  solve::Integration integration;
};

/// Tolerance 0: the Gauss points of whole triangles.
solve::SolveResult computed(const solve::Model& model, const Method& method, double tolerance, int points = 3,
                            int depth = 6) {
  solve::SolveOptions options;
  options.shape.basis = method.basis;
  options.volumetric = method.volumetric;
  options.integration = method.integration;
  options.points_per_cell = points;
  options.integration_tolerance = tolerance;
  options.integration_depth = depth;
  options.tolerance = 0.0005;  // far below the differences to be seen
  return solved(model, options);
}

/// Set-up seconds a point.
double set_up(const solve::SolveResult& result) {
  return result.measures.seconds_setup / static_cast<double>(result.measures.integration_points);
}

struct Table {
  void add(const std::string& what, double value, const std::string& unit, const solve::SolveResult& result,
           const std::string& published = {}, std::optional<double> most = {}) {
    const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
    outcome.figures.push_back({what, published, value, unit, most, {}, reference, seconds});
  }

  void add_points(const std::string& name, const solve::SolveResult& result, const solve::SolveResult& plain) {
    const auto points = static_cast<double>(result.measures.integration_points);
    add(name + "points a node", points / static_cast<double>(result.measures.nodes), "", result);
    add(name + "capped", 100 * static_cast<double>(result.measures.capped_points) / points, "%", result);
    add(name + "set-up a point / plain", set_up(result) / set_up(plain), "", result);
  }

  void add_differences(const std::string& name, const Differences& d, const solve::SolveResult& result,
                       const std::string& published = {}, std::optional<double> most = {}) {
    add(name + "largest", d.largest, "mm", result, published, most);
    add(name + "95 %", d.percentile95, "mm", result);
    add(name + "mean", d.mean, "mm", result);
  }

  Outcome outcome;
  std::string reference;
};

std::string text(double tolerance) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", tolerance);
  return buffer;
}

struct Tolerances {
  std::vector<double> compared;
  double finest;
};

void add_curve(const solve::Model& model, const Method& method, const Tolerances& tolerances, Table& table,
               std::vector<Series>& series) {
  const std::string name = method.name + ", ", finest = text(tolerances.finest);
  table.reference = "the solution with τ = " + finest + ", triangles split 6 times at most";
  const solve::SolveResult plain = computed(model, method, 0), reference = computed(model, method, tolerances.finest);
  table.add(name + "largest displacement", reference.measures.largest_displacement, "mm", reference);
  table.add_points(name + "τ = " + finest + ": ", reference, plain);
  const auto add = [&](const std::string& row, const solve::SolveResult& result) {
    table.add_differences(name + row, apart(result, reference), result);
  };
  add("not adaptive, 1 point a triangle: ", computed(model, method, 0, 1));
  add("not adaptive, 3 points a triangle: ", plain);
  const std::string line = method.basis == Basis::linear ? "published, " : "default, ";
  Series largest{line + "largest", {}, {}}, mean{line + "mean", {}, {}};
  for (const double tolerance : tolerances.compared) {
    const solve::SolveResult result = computed(model, method, tolerance);
    const Differences d = apart(result, reference);
    const bool published = tolerance == 0.1;
    const std::string row = name + "τ = " + text(tolerance) + ": ";
    table.add_points(row, result, plain);
    table.add_differences(row, d, result, published ? "0.035 mm" : "", published ? std::optional(0.035) : std::nullopt);
    largest.x.push_back(tolerance);
    largest.y.push_back(d.largest);
    mean.x.push_back(tolerance);
    mean.y.push_back(d.mean);
  }
  const solve::SolveResult one = computed(model, method, 0.1, 1);
  table.add_points(name + "τ = 0.1, 1 point a part: ", one, plain);
  add("τ = 0.1, 1 point a part: ", one);
  add("τ = " + finest + ", split 3 times at most: ", computed(model, method, tolerances.finest, 3, 3));
  series.push_back(largest);
  series.push_back(mean);
}

}  // namespace

Outcome adaptive_integration(bool small) {
  const solve::Model model = slice_model(5);
  Table table;
  std::vector<Series> series;
  const Method published = {"the method of Wittek et al. (linear MLS, pointwise, plain)", Basis::linear,
                            solve::Volumetric::pointwise, solve::Integration::plain};
  const Method ours = {"the default (MMLS, patches, consistent)", Basis::modified_quadratic,
                       solve::Volumetric::mean_dilatation, solve::Integration::consistent};
  add_curve(model, published,
            small ? Tolerances{{1, 0.1, 0.03}, 0.01} : Tolerances{{1, 0.3, 0.1, 0.03, 0.01, 0.003}, 0.001}, table,
            series);
  if (!small) {  // minutes at a finer one: more nodes a point
    add_curve(model, ours, {{1, 0.3, 0.1, 0.03}, 0.01}, table, series);
  }
  table.outcome.plots.push_back(
      {"adaptive_integration",
       "Slice of a brain, " + std::to_string(model.cloud.size()) + " nodes: difference from the finest solution",
       "integration tolerance", "difference, mm", series, pipelines::Scale::log_log});
  return table.outcome;
}

}  // namespace brainshift::verification::adaptive_cases
