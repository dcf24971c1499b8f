// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lamé's hollow ball, made from a full one: its core is taken out, and a pressure put in its place.
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "discretise/discretise.hpp"
#include "segmentation/surface/resection_wall.hpp"
#include "solve/material/elastic_law.hpp"
#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::verification::resection_cases {

namespace {

constexpr double inner = 10, outer = 20, widened = 0.01;  // mm

/// Lamé: u = A r + B / r², without stress at the outer radius; the inner one is widened.
struct Lame {
  double a, b, pressure;

  explicit Lame(const solve::Material& material) {
    const double shear = solve::shear_modulus(material), bulk = solve::bulk_modulus(material);
    const double ratio = 4 * shear / (3 * bulk * std::pow(outer, 3));  // A / B
    b = widened / (ratio * inner + 1 / (inner * inner));
    a = ratio * b;
    pressure = 4 * shear * b * (1 / std::pow(inner, 3) - 1 / std::pow(outer, 3));
  }
  Points operator()(const Points& x) const {
    const Eigen::ArrayXd r = x.rowwise().norm();
    return x.array().colwise() * (a + b / r.cube());
  }
};

/// 2 in the core, 1 in the rest of the ball: neither nodes nor cells know of the wall between.
LabelMap core_and_shell() {
  constexpr double voxel = 0.5;
  constexpr int half = 42;
  LabelMap labels;
  labels.geometry.size.setConstant(2 * half + 1);
  labels.geometry.spacing.setConstant(voxel);
  labels.geometry.origin.setConstant(-voxel * half);
  labels.voxels.resize(labels.geometry.voxel_count());
  for (int k = -half; k <= half; ++k) {
    for (int j = -half; j <= half; ++j) {
      for (int i = -half; i <= half; ++i) {
        const double r = voxel * Eigen::Vector3d(i, j, k).norm();
        labels.at(i + half, j + half, k + half) = r < inner ? 2 : r < outer + 1 ? 1 : 0;
      }
    }
  }
  return labels;
}

/// The outermost node along each axis, both ways, does not leave it: the ball stays where it is, free to grow.
void hold(solve::Model& model, const Lame& exact) {
  const Points& x = model.cloud.positions;
  const Points u = exact(x);
  model.conditions = test::all_free(model.cloud);
  for (const double side : {-1.0, 1.0}) {
    for (const int axis : {0, 1, 2}) {
      Eigen::Index a = 0;
      (side * x.col(axis)).maxCoeff(&a);
      for (const int other : {(axis + 1) % 3, (axis + 2) % 3}) {
        model.conditions.displacement(a, other) = u(a, other);
      }
    }
  }
}

/// Where the wall of the cavity comes from.
enum class Wall : std::uint8_t { labels_of_points, sphere, label_map };

const char* name_of(Wall wall) {
  return wall == Wall::sphere ? "wall a sphere" : wall == Wall::label_map ? "wall of the label map" : "staircase";
}

std::optional<Surface> surface_of(Wall wall, const LabelMap& labels) {
  if (wall == Wall::labels_of_points) {
    return std::nullopt;
  }
  constexpr std::array<std::uint16_t, 2> brain = {1, 2};
  constexpr double edge_length = 5;
  return wall == Wall::sphere
             ? test::sphere(Eigen::Vector3d::Zero(), inner, 5)
             : segmentation::resection_wall(labels, brain, std::span(brain).last(1), edge_length).surface;
}

/// Bounds, %.
struct Most {
  double mean, percentile95, everywhere;
};

/// The wall is a surface, or a staircase of integration points: it then lies wrong by up to a quarter of a cell's side,
/// and u at it goes with its radius.
std::vector<Figure> emptied_ball(std::size_t nodes, Wall kind, const Most& most) {
  const solve::Material material = {.poisson_ratio = 0.49, .law = solve::Law::linear_elastic};
  const Lame exact(material);
  solve::Model model;
  model.labels = core_and_shell();
  discretise::DiscretiseOptions discretisation;
  discretisation.nodes = nodes;
  const Surface ball = test::sphere(Eigen::Vector3d::Zero(), outer, 5);
  const std::optional<Surface> known = surface_of(kind, *model.labels);
  if (known) {
    discretisation.resected = discretise::ResectedTissue{*known, {2}};
    model.boundary = ball;
  }
  discretise::Discretisation parts = discretise::discretise(ball, &*model.labels, discretisation);
  model.cloud = std::move(parts.cloud);
  model.cells = std::move(parts.cells);
  model.materials[1] = material;
  model.resection = solve::Resection{.labels = {2}, .pressure = exact.pressure, .wall = known};
  hold(model, exact);
  solve::SolveOptions options;
  options.tolerance = 1e-5;
  const solve::SolveResult result = solved(model, options);

  const Points wall = test::sphere(Eigen::Vector3d::Zero(), inner, 4).vertices;
  const Differences at_wall = differences(result.solution, wall, exact(wall));
  const Points& x = result.solution.positions;
  const Eigen::ArrayXd outside = (x.rowwise().norm().array() >= inner).cast<double>();
  const Eigen::ArrayXd off = (result.solution.displacement - exact(x)).rowwise().norm();
  const double mean = (off * outside).sum() / outside.sum();
  const double volume = 4 * std::numbers::pi / 3 * std::pow(inner, 3);
  const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
  const std::string name = "ball emptied, " + std::to_string(nodes) + " nodes, " + name_of(kind) + ": ",
                    lame = "analytic (Lamé)";
  const auto percent = [](double part) { return 100 * part / widened; };
  return {
      {name + "mean difference / widening, at the wall", "", percent(at_wall.mean), "%", most.mean, {}, lame, seconds},
      {name + "95 %", "", percent(at_wall.percentile95), "%", most.percentile95, {}, lame, seconds},
      {name + "largest", "", percent(at_wall.largest), "%", {}, {}, lame, seconds},
      {name + "mean, everywhere", "", percent(mean), "%", most.everywhere, {}, lame, seconds},
      {name + "volume taken out",
       "",
       100 * std::abs(result.measures.resection->removed_volume / volume - 1),
       "%",
       5,
       {},
       "4/3 pi r^3",
       seconds}};
}

}  // namespace

Outcome resection(bool small) {
  Outcome outcome;
  const auto add = [&](std::size_t nodes, Wall wall, const Most& most) {
    for (const Figure& figure : emptied_ball(nodes, wall, most)) {
      outcome.figures.push_back(figure);
    }
  };
  add(1500, Wall::labels_of_points, {11, 30, 4});
  add(1500, Wall::sphere, {3, 9, 2});
  if (!small) {
    add(12000, Wall::sphere, {1, 3, 1});
    add(12000, Wall::label_map, {1.2, 3, 1});  // that wall itself is off by up to 1.5 % of the radius
  }
  return outcome;
}

}  // namespace brainshift::verification::resection_cases
