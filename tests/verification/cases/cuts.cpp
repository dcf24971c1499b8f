// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wittek et al., section 6.3: a square with a kinked cut lengthened by 20 %, cut before and while it is stretched; and
// a half-cut block in space.
#include <algorithm>
#include <cmath>

#include "solve/output/field_difference.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/verification/block_picture.hpp"
#include "tests/verification/cases/block_model.hpp"
#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/reference.hpp"
#include "tests/verification/slice.hpp"

namespace brainshift::verification::cuts_cases {

namespace {

constexpr double side = 100, pulled = 20;  // mm
const Eigen::Vector3d tip(50, 62, 0);
constexpr double faces_and_tip = 140;  // samples after those inside

/// Nodes four times as near to each other at the tip as elsewhere; triangles between them.
solve::Model square(double least_distance) {
  solve::Model model;
  model.plane = solve::Plane::strain;
  model.cloud = rectangle_cloud(side, side, least_distance, 4,
                                [](const Eigen::Vector3d& x) { return std::clamp((x - tip).norm() / 20, 0.25, 1.0); });
  model.conditions = test::all_free(model.cloud);
  Points outline(4, 3);
  outline << 0, 0, 0, side, 0, 0, side, side, 0, 0, side, 0;
  model.cells = triangles_in(outline, model.cloud.positions);
  model.materials[1] = {3000, 0.49, 1000};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double y = model.cloud.positions(a, 1);
    if (y == 0 || y == side) {
      model.conditions.displacement.row(a) << 0, (y == 0 ? 0 : pulled), 0;
    }
  }
  return model;
}

solve::Cut kinked() {
  solve::Cut cut;
  cut.name = "the kinked cut";
  cut.vertices.resize(3, 3);
  cut.vertices << 0, 50, 0, 30, 50, 0, tip.transpose();
  return cut;
}

solve::SolveOptions plane_options() {
  solve::SolveOptions options = steady_options();
  options.points_per_cell = 3;
  return options;
}

/// Cut from 1 to 2, after it was stretched from 0 to 1.
solve::SolveResult cut_while_stretched(solve::Model model, int load_steps) {
  const double first = 30, all = first + std::hypot(20, 12);
  model.cuts[0].time = {1, 1 + first / all, 2};
  model.curve = solve::LoadCurve({0, 1, 2.2}, {0, 1, 1}, solve::LoadCurve::Join::smooth);
  solve::SolveOptions options = plane_options();
  options.load_steps = load_steps;
  return solved(model, options);
}

double seconds_a_step(const solve::SolveResult& result) {
  const double cutting = result.measures.cut ? result.measures.cut->seconds : 0;
  return (result.measures.seconds_stepping - cutting) / result.measures.steps;
}

/// Rows of one comparison.
class Rows {
 public:
  Rows(Outcome& outcome, std::string reference) : outcome_(outcome), reference_(std::move(reference)) {}
  void add(const std::string& what, const std::string& published, double value, const std::string& unit,
           std::optional<double> most, const solve::SolveResult& result) {
    const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
    outcome_.figures.push_back({what, published, value, unit, most, {}, reference_, seconds});
  }

 private:
  Outcome& outcome_;
  std::string reference_;
};

/// Bounds of the mean and the largest difference, mm, and of the force, %.
struct Bounds {
  double force, largest, mean;
};

/// Against finite elements: mean over the samples inside, which lie evenly, largest over all.
void add_differences(const std::string& name, const solve::SolveResult& result, const Reference& reference, int axis,
                     const Bounds& bounds, bool published, Rows& rows) {
  const Eigen::Index inside = reference.positions.rows() - static_cast<Eigen::Index>(faces_and_tip);
  const Differences all = differences(result.solution, reference.positions, reference.displacement);
  const Differences even =
      differences(result.solution, reference.positions.topRows(inside), reference.displacement.topRows(inside));
  const double force = 100 * std::abs(result.history.back().reaction[axis] / reference.converged_force - 1);
  rows.add(name + "force", published ? "0.5 %" : "", force, "%", bounds.force, result);
  rows.add(name + "largest difference, faces and tip too", published ? "0.5 mm" : "", all.largest, "mm", bounds.largest,
           result);
  rows.add(name + "mean difference", published ? "0.03 mm" : "", even.mean, "mm", bounds.mean, result);
}

void add_cost(const solve::SolveResult& uncut, const solve::SolveResult& cut, const solve::SolveResult& progressive,
              Rows& rows) {
  const solve::CutMeasures& m = *progressive.measures.cut;
  const auto points = static_cast<double>(progressive.measures.integration_points);
  const double touched = static_cast<double>(m.touched_supports) / static_cast<double>(m.advances);
  rows.add("seconds a step, cut / uncut", "", seconds_a_step(cut) / seconds_a_step(uncut), "", {}, cut);
  rows.add("seconds a step, cut on the way / uncut", "", seconds_a_step(progressive) / seconds_a_step(uncut), "", {},
           progressive);
  rows.add("cutting, a millimetre", "", m.seconds / m.extent, "s", {}, progressive);
  rows.add("supports evaluated again at an advance, of all", "", 100 * touched / points, "%", {}, progressive);
  rows.add("nodes split", "", static_cast<double>(m.split_nodes), "", {}, progressive);
  rows.add("nodes added", "", static_cast<double>(m.added_nodes), "", {}, progressive);
}

Plot deformed_nodes(const std::string& file, const std::string& title, const Solution& solution) {
  const Points places = solution.positions + solution.displacement;
  Series nodes{"nodes", {}, {}, false};
  nodes.x.assign(places.col(0).begin(), places.col(0).end());
  nodes.y.assign(places.col(1).begin(), places.col(1).end());
  return {file, title, "x, mm", "y, mm", {nodes}};
}

/// Half a block, z = 30, as triangles that reach beyond its sides.
solve::Cut sheet(int divisions) {
  solve::Cut cut;
  cut.name = "the sheet";
  const int n = divisions + 1;
  cut.vertices.resize(n * n, 3);
  cut.triangles.resize(2 * divisions * divisions, 3);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      cut.vertices.row(j * n + i) << -3 + 33.0 * i / divisions, -3 + 36.0 * j / divisions, 30;
      if (i < divisions && j < divisions) {
        const int a = j * n + i, t = 2 * (j * divisions + i);
        cut.triangles.row(t) << a, a + 1, a + n + 1;
        cut.triangles.row(t + 1) << a, a + n + 1, a + n;
      }
    }
  }
  return cut;
}

}  // namespace

Outcome cut_path(bool small) {
  Outcome outcome;
  const Reference reference = read_reference("cut_path", "cut_path_force");
  solve::Model model = square(small ? 2.2 : 1.15);
  const solve::SolveResult uncut = solved(model, plane_options());
  model.cuts = {kinked()};
  const solve::SolveResult cut = solved(model, plane_options());
  const solve::SolveResult progressive = cut_while_stretched(model, small ? 3000 : 8000);
  const std::string nodes = std::to_string(cut.measures.nodes) + " nodes, ";
  const Bounds bounds = small ? Bounds{1, 0.8, 0.04} : Bounds{0.5, 0.4, 0.02};
  Rows against_fe(outcome, reference.error);
  add_differences(nodes, cut, reference, 1, bounds, true, against_fe);
  add_differences(nodes + "cut while stretched: ", progressive, reference, 1, bounds, false, against_fe);
  Rows against_static(outcome, "the body that was cut before");
  const Points u = displacement_at(cut.solution, reference.positions);
  const Differences apart = differences(progressive.solution, reference.positions, u);
  const double force = 100 * std::abs(progressive.history.back().reaction.y() / cut.history.back().reaction.y() - 1);
  against_static.add("cut while stretched: force", "", force, "%", 0.5, progressive);
  against_static.add("cut while stretched: mean difference", "", apart.mean, "mm", small ? 0.04 : 0.02, progressive);
  add_cost(uncut, cut, progressive, against_static);
  outcome.plots.push_back(deformed_nodes("cut_path", "A square, cut while it is stretched", progressive.solution));
  return outcome;
}

Outcome cut_block(bool small) {
  Outcome outcome;
  const Reference reference = read_reference("cut_block", "cut_block_force");
  solve::Model model = block_model(small ? 3.6 : 2.6, {0, 0, 12});
  model.cuts = {sheet(12)};
  Rows rows(outcome, reference.error);
  const solve::SolveResult cut = solved(model, steady_options());
  const std::string nodes = std::to_string(cut.measures.nodes) + " nodes, ";
  const Bounds bounds = small ? Bounds{2, 1.2, 0.1} : Bounds{1, 0.8, 0.1};
  add_differences(nodes, cut, reference, 2, bounds, false, rows);
  for (Eigen::Index v = 0; v < model.cuts[0].vertices.rows(); ++v) {
    model.cuts[0].time.push_back(1 + (model.cuts[0].vertices(v, 0) + 3) / 33);
  }
  model.curve = solve::LoadCurve({0, 1, 2.2}, {0, 1, 1}, solve::LoadCurve::Join::smooth);
  solve::SolveOptions options = steady_options();
  options.load_steps = 2000;
  const solve::SolveResult progressive = solved(model, options);
  add_differences(nodes + "cut while stretched: ", progressive, reference, 2, bounds, false, rows);
  const solve::CutMeasures& m = *progressive.measures.cut;
  const double touched = static_cast<double>(m.touched_supports) / static_cast<double>(m.advances);
  rows.add("supports evaluated again at an advance, of all", "",
           100 * touched / static_cast<double>(progressive.measures.integration_points), "%", {}, progressive);
  rows.add("cutting, a square centimetre", "", 100 * m.seconds / m.extent, "s", {}, progressive);
  outcome.pictures.push_back({"cut_block", picture_of_cut_block(progressive.solution, block_size, block_rim)});
  return outcome;
}

}  // namespace brainshift::verification::cuts_cases
