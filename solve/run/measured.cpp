// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/measured.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "solve/cut/resection.hpp"
#include "solve/measured/inner_rows.hpp"
#include "solve/measured/weight.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/pressure_patches.hpp"
#include "solve/run/coarse.hpp"
#include "solve/run/prepare.hpp"
#include "solve/run/whole_body.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

namespace {

constexpr std::size_t most_nodes = 500;  // of the cloud on which the weight is chosen
constexpr Eigen::Index most_points = 60;
constexpr double nodes_a_patch = 8;

void check_parts(const Model& model, const SolveOptions& options) {
  const std::array<std::pair<bool, const char*>, 7> unfit = {{
      {options.dynamics == Dynamics::transient, "motion in time"},
      {options.imposition == Imposition::simplified, "the simplified imposition"},
      {options.region > 0, "a region"},
      {!model.cuts.empty() || model.rupture, "cuts and tears"},
      {model.septum.has_value(), "a septum"},
      {model.resection.has_value(), "a resection"},
      {model.plane != Plane::none, "a plane problem"},
  }};
  for (const auto& [there, what] : unfit) {
    if (there) {
      throw std::invalid_argument(std::string("a load with noise does not go with ") + what +
                                  "; leave the one or the other out");
    }
  }
}

/// What is measured, at places of the body: nodes under the opening that are nearest to having one point's value, and
/// the inner points.
struct Seen {
  Points positions, displacement, sigma;
};

/// Of each point of the cortex the node that it has the largest share in.
Seen seen_points(const Model& model) {
  const Measurement& m = *model.conditions.measured;
  const Eigen::Index cortex = m.sigma.rows();
  Seen seen{Points(cortex + m.inner.rows(), 3), Points(cortex + m.inner.rows(), 3), Points(cortex + m.inner.rows(), 3)};
  for (Eigen::Index p = 0; p < cortex; ++p) {
    Eigen::Index node = 0;
    Eigen::VectorXd(m.spread.col(p)).maxCoeff(&node);
    seen.positions.row(p) = model.cloud.positions.row(node);
    seen.displacement.row(p) = model.conditions.displacement.row(node);
    seen.sigma.row(p) = m.sigma.row(p);
  }
  seen.positions.bottomRows(m.inner.rows()) = m.inner;
  seen.displacement.bottomRows(m.inner.rows()) = m.inner_displacement;
  seen.sigma.bottomRows(m.inner.rows()) = m.inner_sigma;
  return seen;
}

/// At most so many, each the farthest from those before it.
std::vector<Eigen::Index> spread_out(const Points& positions, Eigen::Index most) {
  std::vector<Eigen::Index> chosen = {0};
  Eigen::VectorXd distance = (positions.rowwise() - positions.row(0)).rowwise().norm();
  while (static_cast<Eigen::Index>(chosen.size()) < std::min(most, positions.rows())) {
    Eigen::Index next = 0;
    if (!(distance.maxCoeff(&next) > 0)) {
      break;
    }
    chosen.push_back(next);
    distance = distance.cwiseMin((positions.rowwise() - positions.row(next)).rowwise().norm());
  }
  return chosen;
}

/// The model on a few hundred of its nodes.
BodyParts few_nodes(const Model& model, ShapeOptions shape_options, std::optional<ShapeFunctions>& shape) {
  NodeCloud cloud = model.cloud;
  Conditions conditions = model.conditions;
  while (cloud.size() > most_nodes) {
    const std::vector<std::int32_t> nodes = coarse_nodes(cloud, conditions);
    if (nodes.size() >= cloud.size()) {
      break;
    }
    const double wider = std::cbrt(static_cast<double>(cloud.size()) / static_cast<double>(nodes.size()));
    cloud = subset(cloud, nodes);
    conditions = subset(conditions, nodes);
    for (double& spacing : cloud.spacing) {
      spacing *= wider;
    }
  }
  BodyParts parts;
  parts.cloud = order_nodes(cloud, conditions);
  shape_options = {.basis = Basis::linear, .derivatives = shape_options.derivatives};
  shape.emplace(parts.cloud.positions, parts.cloud.spacing, shape_options);
  const LabelMap* labels = model.labels ? &*model.labels : nullptr;
  parts.points = integration_points(model.cells, 1, labels, tissues_of(model));
  parts.point_rows = shape->evaluate(parts.points.positions, true);
  parts.materials = material_table(model.materials, parts.points.label);
  const double volume = std::accumulate(parts.points.volume.begin(), parts.points.volume.end(), 0.0);
  std::vector<double> share = parts.points.volume;
  for (double& s : share) {
    s *= static_cast<double>(parts.cloud.size()) / volume;
  }
  parts.patches = pressure_patches(parts.points.positions, share, parts.materials.row_of_point, nodes_a_patch);
  return parts;
}

Points stacked(const Points& above, const Points& below) {
  Points both(above.rows() + below.rows(), 3);
  both << above, below;
  return both;
}

}  // namespace

MeasuredFit fit_measured(const Model& model, const SolveOptions& options) {
  const Measurement& measured = *model.conditions.measured;
  std::optional<ShapeFunctions> shape;
  const BodyParts parts = few_nodes(model, options.shape, shape);
  const Seen seen = seen_points(model);
  const std::vector<Eigen::Index> used = spread_out(seen.positions, most_points);
  const Points places = stacked(seen.positions(used, Eigen::all), measured.asked);
  Response response = linear_response(parts, inner_rows(*shape, places), model.skull.has_value());
  if (measured.registration_unknown) {
    response.rigid = rigid_motions(places, places.topRows(static_cast<Eigen::Index>(used.size())));
  }
  MeasuredFit fit =
      choose_weight(response, seen.displacement(used, Eigen::all), seen.sigma(used, Eigen::all), measured.weight);
  const Points about = seen.positions(used, Eigen::all);
  fit.motion_centre = about.colwise().mean().transpose();
  fit.motion_size = (about.rowwise() - fit.motion_centre.transpose()).rowwise().norm().mean();
  return fit;
}

SolveResult solve_measured(const Model& model, const SolveOptions& options, const Progress& progress) {
  check_parts(model, options);
  report(progress, 0, "weighing the deformation against the noise");
  MeasuredFit fit = fit_measured(model, options);
  Model weighed = model;
  weighed.conditions.measured->weight = fit.weight;
  SolveResult result = solve_whole_body(weighed, options, progress);
  result.measures.measured = std::move(fit);
  return result;
}

}  // namespace brainshift::solve
