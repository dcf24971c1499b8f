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
#include "solve/load/noisy_load.hpp"
#include "solve/load/spread_out.hpp"
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

Points stacked(const Points& above, const Points& below) {
  Points both(above.rows() + below.rows(), 3);
  both << above, below;
  return both;
}

/// Of each point of the cortex the node that it has the largest share in, none of one without a share, as where the
/// nodes are fewer; the point itself where some count for less, as one that is wrong has shares in the nodes at its
/// neighbours, too.
Seen seen_points(const Model& model, bool themselves) {
  const Measurement& m = *model.conditions.measured;
  if (themselves) {
    return {stacked(m.cortex, m.inner), stacked(m.cortex_displacement, m.inner_displacement),
            stacked(m.sigma, m.inner_sigma)};
  }
  std::vector<Eigen::Index> points, nodes;
  for (Eigen::Index p = 0; p < m.sigma.rows(); ++p) {
    Eigen::Index node = 0;
    if (Eigen::VectorXd(m.spread.col(p)).maxCoeff(&node) > 0) {
      points.push_back(p);
      nodes.push_back(node);
    }
  }
  return {stacked(model.cloud.positions(nodes, Eigen::all), m.inner),
          stacked(model.conditions.displacement(nodes, Eigen::all), m.inner_displacement),
          stacked(m.sigma(points, Eigen::all), m.inner_sigma)};
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

/// Each node by itself: the response to forces on its parameters.
void append_nodes(std::size_t nodes, ShapeRows& rows) {
  constexpr double one = 1;
  for (std::size_t a = 0; a < nodes; ++a) {
    const auto node = static_cast<std::int32_t>(a);
    rows.append({std::span(&node, 1), std::span(&one, 1), {}});
  }
}

/// Φ C Φᵀ of each row, with C the joint covariance of the parameters.
Eigen::MatrixXd covariance_of(const ShapeRows& rows, const Eigen::MatrixXd& joint) {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(rows.size()), 6);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ShapeRow row = rows[i];
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t a = 0; a < row.size(); ++a) {
      for (std::size_t b = 0; b < row.size(); ++b) {
        sum += row.value[a] * row.value[b] * joint.block<3, 3>(3 * row.node[a], 3 * row.node[b]);
      }
    }
    result.row(static_cast<Eigen::Index>(i)) = six_entries(sum);
  }
  return result;
}

/// What the fit is made on: the thinned body, and of what is measured as many points as are used.
struct Thinned {
  std::optional<ShapeFunctions> shape;
  BodyParts parts;
  Points positions, displacement, sigma;

  Thinned(const Model& model, const SolveOptions& options)
      : Thinned(model, options, seen_points(model, model.conditions.measured->trust.size() > 0)) {}
  Thinned(const Model& model, const SolveOptions& options, const Seen& seen)
      : parts(few_nodes(model, options.shape, shape)) {
    const std::vector<Eigen::Index> used = spread_out(seen.positions, most_points);
    positions = seen.positions(used, Eigen::all);
    displacement = seen.displacement(used, Eigen::all);
    sigma = seen.sigma(used, Eigen::all);
  }
};

/// Whether all of a node's displacement is prescribed and none of it measured.
bool is_held(const Conditions& conditions, Eigen::Index node) {
  return conditions.displacement.row(node).allFinite() && conditions.measured->spread.row(node).norm() == 0;
}

/// places: what the rows see, the measured points first.
Response response_of(const Thinned& thin, const Model& model, const ShapeRows& rows, const Points& places) {
  Response response = linear_response(thin.parts, rows, model.skull.has_value());
  if (model.conditions.measured->registration_unknown) {
    response.rigid = rigid_motions(places, thin.positions);
  }
  return response;
}

}  // namespace

MeasuredFit fit_measured(const Model& model, const SolveOptions& options) {
  const Thinned thin(model, options);
  const Measurement& measured = *model.conditions.measured;
  const Points places = stacked(thin.positions, measured.asked);
  const Response response = response_of(thin, model, inner_rows(*thin.shape, places), places);
  MeasuredFit fit = choose_weight(response, thin.displacement, thin.sigma, measured.weight);
  fit.motion_centre = thin.positions.colwise().mean().transpose();
  fit.motion_size = (thin.positions.rowwise() - fit.motion_centre.transpose()).rowwise().norm().mean();
  return fit;
}

Eigen::MatrixXd measured_covariance(const Model& model, const SolveOptions& options, const MeasuredFit& fit) {
  const Thinned thin(model, options);
  ShapeRows rows = inner_rows(*thin.shape, thin.positions);
  append_nodes(thin.parts.cloud.size(), rows);
  const Points places = stacked(thin.positions, thin.parts.cloud.positions);
  const Response response = response_of(thin, model, rows, places);
  const Eigen::MatrixXd joint = posterior_covariance(response, thin.sigma, fit);
  Eigen::MatrixXd covariance = covariance_of(inner_rows(*thin.shape, model.cloud.positions), joint);
  for (Eigen::Index a = 0; a < covariance.rows(); ++a) {
    if (is_held(model.conditions, a)) {
      covariance.row(a).setZero();  // a ball about it reaches past the body
    }
  }
  return covariance;
}

std::optional<Outlier> worst_outlier(const Model& model, const SolveOptions& options, const MeasuredFit& fit) {
  constexpr double surprising = 5;  // 60 points of a Gaussian have one in a thousand runs
  const Thinned thin(model, options);
  const Response response = response_of(thin, model, inner_rows(*thin.shape, thin.positions), thin.positions);
  const Eigen::VectorXd off = surprise(response, thin.displacement, thin.sigma, fit.weight);
  std::vector<double> sorted(off.begin(), off.end());
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double usual = std::max(1.0, sorted[sorted.size() / 2] / usual_surprise);
  Eigen::Index worst = 0;
  if (!(off.maxCoeff(&worst) > surprising * usual)) {
    return std::nullopt;
  }
  return Outlier{thin.positions.row(worst), off[worst] / usual};
}

LessenedPoints lessen_outliers(Model& model, const SolveOptions& options, const OpeningOptions& opening) {
  check_parts(model, options);
  std::optional<ShapeFunctions> shape;
  const BodyParts parts = few_nodes(model, options.shape, shape);
  const Seen seen = seen_points(model, true);
  const double weight = model.conditions.measured->weight;
  const Response response = linear_response(parts, inner_rows(*shape, seen.positions), model.skull.has_value());
  const Eigen::VectorXd trust = robust_weights(response, seen.displacement, seen.sigma, weight);
  std::vector<Eigen::Index> kept, lessened;
  for (Eigen::Index i = 0; i < trust.size(); ++i) {
    if (trust[i] > least_trust) {
      kept.push_back(i);
    }
    if (trust[i] < 0.5) {
      lessened.push_back(i);
    }
  }
  const Points raised = seen.sigma.array().colwise() / trust.array().sqrt();
  Conditions weighed = noisy_conditions(
      model.cloud, {seen.positions(kept, Eigen::all), seen.displacement(kept, Eigen::all), raised(kept, Eigen::all)},
      opening);
  weighed.force = std::move(model.conditions.force);
  weighed.measured->weight = weight;
  weighed.measured->trust = trust(kept);
  model.conditions = std::move(weighed);
  return {seen.positions(lessened, Eigen::all), trust.size()};
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
