// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/measured.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "solve/cut/resection.hpp"
#include "solve/interface/unfit_parts.hpp"
#include "solve/load/noisy_load.hpp"
#include "solve/load/spread_out.hpp"
#include "solve/measured/inner_rows.hpp"
#include "solve/measured/surprise.hpp"
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
constexpr double nodes_a_patch = 8;

void check_parts(const Model& model, const SolveOptions& options) {
  std::vector<UnfitPart> unfit = beyond_rest(model, options);
  unfit.insert(unfit.begin() + 1, {options.imposition == Imposition::simplified, "the simplified imposition"});
  refuse_unfit("a load with noise does not go", unfit, "leave the one or the other out");
}

Points stacked(const Points& above, const Points& below) {
  Points both(above.rows() + below.rows(), 3);
  both << above, below;
  return both;
}

/// What is measured, the points of the cortex first.
struct Seen {
  Points positions, displacement, sigma;

  explicit Seen(const Measurement& m)
      : positions(stacked(m.cortex, m.inner)),
        displacement(stacked(m.cortex_displacement, m.inner_displacement)),
        sigma(stacked(m.sigma, m.inner_sigma)) {}
};

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

/// What the fit is made on: the thinned body, and what is measured, spread out first.
struct Thinned {
  std::optional<ShapeFunctions> shape;
  BodyParts parts;
  std::vector<Eigen::Index> points;  // of Seen
  Points positions, displacement, sigma;

  Thinned(const Model& model, const SolveOptions& options) : parts(few_nodes(model, options.shape, shape)) {
    const Seen seen(*model.conditions.measured);
    points = spread_out(seen.positions, seen.positions.rows());
    positions = seen.positions(points, Eigen::all);
    displacement = seen.displacement(points, Eigen::all);
    sigma = seen.sigma(points, Eigen::all);
  }
};

/// Whether all of a node's displacement is prescribed and none of it measured.
bool is_held(const Conditions& conditions, Eigen::Index node) {
  return conditions.displacement.row(node).allFinite() && conditions.measured->spread.row(node).norm() == 0;
}

/// Lets a smooth motion of the opening move its points as they were measured, and all else as the body carries it; not
/// where the registration, which would share it, is unknown, or the weight is given.
void add_smooth_motion(const Thinned& thin, const Model& model, const ShapeRows& rows, Response& response) {
  const Measurement& m = *model.conditions.measured;
  if (m.registration_unknown || m.cortex.rows() == 0 || m.weight > 0) {
    return;
  }
  std::vector<Eigen::Index> on_cortex;  // rows
  for (std::size_t i = 0; i < thin.points.size(); ++i) {
    if (thin.points[i] < m.cortex.rows()) {
      on_cortex.push_back(static_cast<Eigen::Index>(i));
    }
  }
  const Carried carried = carried_motion(thin.parts, rows, model.skull.has_value());
  const auto own = static_cast<Eigen::Index>(on_cortex.size());
  response.sites =
      stacked(thin.positions(on_cortex, Eigen::all), thin.parts.cloud.positions(carried.nodes, Eigen::all));
  response.carry = Eigen::MatrixXd::Zero(response.compliance.rows(), 3 * response.sites.rows());
  response.carry.rightCols(carried.motion.cols()) = carried.motion;
  for (Eigen::Index i = 0; i < own; ++i) {
    auto row = response.carry.middleRows<3>(3 * on_cortex[static_cast<std::size_t>(i)]);
    row.setZero();
    row.middleCols<3>(3 * i).setIdentity();
  }
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
  const ShapeRows rows = inner_rows(*thin.shape, places);
  Response response = response_of(thin, model, rows, places);
  add_smooth_motion(thin, model, rows, response);
  MeasuredFit fit = choose_weight(response, thin.displacement, thin.sigma, measured.weight);
  fit.motion_centre = thin.positions.colwise().mean().transpose();
  fit.motion_size = (thin.positions.rowwise() - fit.motion_centre.transpose()).rowwise().norm().mean();
  if (fit.smooth.length > 0) {
    Points smoothed = measured.cortex_displacement;  // of points that are there twice, as measured
    for (std::size_t i = 0; i < thin.points.size(); ++i) {
      if (thin.points[i] < smoothed.rows()) {
        smoothed.row(thin.points[i]) = fit.smoothed.row(static_cast<Eigen::Index>(i));
      }
    }
    fit.smoothed = std::move(smoothed);
  }
  return fit;
}

Conditions weighed_conditions(const Model& model, const MeasuredFit& fit) {
  Conditions conditions = model.conditions;
  Measurement& measured = *conditions.measured;
  measured.weight = fit.weight;
  if (fit.smooth.length > 0) {
    conditions.displacement += measured.spread * (fit.smoothed - measured.cortex_displacement);
    measured.spread.setZero();
    if (measured.inner.rows() == 0) {
      conditions.measured.reset();
    }
  }
  return conditions;
}

Eigen::MatrixXd measured_covariance(const Model& model, const SolveOptions& options, const MeasuredFit& fit) {
  const Thinned thin(model, options);
  ShapeRows rows = inner_rows(*thin.shape, thin.positions);
  append_nodes(thin.parts.cloud.size(), rows);
  const Points places = stacked(thin.positions, thin.parts.cloud.positions);
  Response response = response_of(thin, model, rows, places);
  add_smooth_motion(thin, model, rows, response);
  const Eigen::MatrixXd joint = posterior_covariance(response, thin.sigma, fit);
  Eigen::MatrixXd covariance = covariance_of(inner_rows(*thin.shape, model.cloud.positions), joint);
  for (Eigen::Index a = 0; a < covariance.rows(); ++a) {
    if (is_held(model.conditions, a)) {
      covariance.row(a).setZero();  // a ball about it reaches past the body
    }
  }
  return covariance;
}

std::optional<Outlier> worst_outlier(const Model& model, const SolveOptions& options) {
  const Thinned thin(model, options);
  // Without a smooth motion: one alike over short lengths takes a wrong point for one of its own.
  const Response response = response_of(thin, model, inner_rows(*thin.shape, thin.positions), thin.positions);
  const MeasuredFit fit = choose_weight(response, thin.displacement, thin.sigma, model.conditions.measured->weight);
  const Eigen::VectorXd off = surprise(response, thin.displacement, thin.sigma, fit);
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
  const Seen seen(*model.conditions.measured);
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
  weighed.at_nodes_alone = model.conditions.at_nodes_alone;
  weighed.measured->weight = weight;
  model.conditions = std::move(weighed);
  return {seen.positions(lessened, Eigen::all), trust.size()};
}

SolveResult solve_measured(const Model& model, const SolveOptions& options, const Progress& progress) {
  check_parts(model, options);
  report(progress, 0, "weighing the deformation against the noise");
  MeasuredFit fit = fit_measured(model, options);
  Model weighed = model;
  weighed.conditions = weighed_conditions(model, fit);
  SolveResult result = solve_whole_body(weighed, options, progress);
  result.measures.measured = std::move(fit);
  return result;
}

}  // namespace brainshift::solve
