// SPDX-License-Identifier: GPL-3.0-or-later
//
// Figure 8 of the source: brain shift in the plane, triangles whose corners are the nodes, three Gauss points each; how
// far the displacements lie from those of τ = 0.001.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/reference.hpp"
#include "tests/verification/slice.hpp"

namespace brainshift::verification {

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
  model.cells = triangles_in(outline, model.cloud.positions);
  model.materials[1] = {3000, 0.49, 1000};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double distance = model.cloud.positions.row(a).norm(), t = 1 - distance / opening;
    if (model.cloud.on_surface[static_cast<std::size_t>(a)] == 0) {
      continue;
    }
    if (t > 0) {
      model.cloud.prescribed_displacement.row(a) = pushed * t * t * t * (10 - 15 * t + 6 * t * t) * direction;
    } else if (distance > held_from) {
      model.cloud.prescribed_displacement.row(a).setZero();
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

/// How the integration is done in one computation.
struct Setting {
  Basis basis;
  int points;  ///< of a triangle or part
  double tolerance = 0;
  int depth = 6;
};

solve::SolveResult computed(const solve::Model& model, const Setting& setting) {
  solve::SolveOptions options;
  options.shape.basis = setting.basis;
  options.points_per_cell = setting.points;
  options.integration_tolerance = setting.tolerance;
  options.integration_depth = setting.depth;
  options.tolerance = 0.0005;  // far below the differences to be seen
  return solved(model, options);
}

/// Set-up seconds a point.
double set_up(const solve::SolveResult& result) {
  return result.measures.seconds_setup / static_cast<double>(result.measures.integration_points);
}

class Table {
 public:
  explicit Table(std::string reference) : reference_(std::move(reference)) {}

  void add(const std::string& what, double value, const std::string& unit, const solve::SolveResult& result,
           const std::string& published = {}, std::optional<double> most = {}) {
    const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
    outcome.figures.push_back({what, published, value, unit, most, {}, reference_, seconds});
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

 private:
  std::string reference_;
};

std::string text(double tolerance) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", tolerance);
  return buffer;
}

void add_curve(const solve::Model& model, const std::string& name, Basis basis, double finest, Table& table,
               std::vector<Series>& series) {
  const solve::SolveResult plain = computed(model, {basis, 3}), reference = computed(model, {basis, 3, finest});
  table.add(name + "largest displacement", reference.measures.largest_displacement, "mm", reference);
  table.add_points(name + "τ = " + text(finest) + ": ", reference, plain);
  for (const int points : {1, 3}) {
    const solve::SolveResult grid = points == 3 ? plain : computed(model, {basis, points});
    const std::string row = name + "not adaptive, " + std::to_string(points) + " a triangle: ";
    table.add_differences(row, apart(grid, reference), grid);
  }
  Series largest{name + "largest", {}, {}}, mean{name + "mean", {}, {}};
  for (const double tolerance : {1.0, 0.3, 0.1, 0.03, 0.01, 0.003}) {
    if (tolerance <= finest) {
      continue;
    }
    const solve::SolveResult result = computed(model, {basis, 3, tolerance});
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
  series.push_back(largest);
  series.push_back(mean);
}

}  // namespace

Outcome adaptive_integration(bool small) {
  const solve::Model model = slice_model(small ? 8 : 4);
  const double finest = small ? 0.01 : 0.001;
  Table table("the solution with τ = " + text(finest) + ", triangles split 6 times at most");
  std::vector<Series> series;
  for (const auto& [name, basis] : {std::pair{"MMLS", Basis::modified_quadratic}, {"MLS", Basis::linear}}) {
    add_curve(model, std::string(name) + ", ", basis, finest, table, series);
  }
  table.outcome.plots.push_back({"adaptive_integration",
                                 "Brain slice: difference from the solution with τ = " + text(finest),
                                 "integration tolerance τ", "difference, mm", series, true});
  return table.outcome;
}

}  // namespace brainshift::verification
