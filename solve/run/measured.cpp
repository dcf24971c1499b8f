// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/measured.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "solve/interface/unfit_parts.hpp"
#include "solve/load/noisy_load.hpp"
#include "solve/load/openings.hpp"
#include "solve/load/spread_out.hpp"
#include "solve/measured/inner_rows.hpp"
#include "solve/measured/surprise.hpp"
#include "solve/measured/weight.hpp"
#include "solve/run/whole_body.hpp"

namespace brainshift::solve {

namespace {

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

/// Places so far outside that no node sees them move to the nearest node: nothing is said there that anyone uses.
Points within_sight(Points places, const Points& nodes) {
  constexpr double sight = 20;  // mm
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    Eigen::Index nearest = 0;
    if ((nodes.rowwise() - places.row(i)).rowwise().norm().minCoeff(&nearest) > sight) {
      places.row(i) = nodes.row(nearest);
    }
  }
  return places;
}

/// What is measured, the points of the cortex first.
struct Seen {
  Points positions, displacement, sigma;

  explicit Seen(const Measurement& m)
      : positions(stacked(m.cortex, m.inner)),
        displacement(stacked(m.cortex_displacement, m.inner_displacement)),
        sigma(stacked(m.sigma, m.inner_sigma)) {}
};

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

/// Φ û of each row, (rows × 3).
Points values_of(const ShapeRows& rows, const Points& parameters) {
  Points values = Points::Zero(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t a = 0; a < rows[i].size(); ++a) {
      values.row(static_cast<Eigen::Index>(i)) += rows[i].value[a] * parameters.row(rows[i].node[a]);
    }
  }
  return values;
}

/// The displacement of an answer as rows of the thinned body see it. displacement: at the nodes of the whole cloud.
Points answered_at(const ShapeRows& rows, const ThinnedBody& thinned, const ShapeFunctions& shape,
                   const Points& displacement) {
  return values_of(
      rows, parameters_from_displacement(shape, thinned.stiff.cloud.positions, displacement(thinned.node, Eigen::all)));
}

/// Of each place, as_said().
void say(const Points& linear, const Points& answered, Eigen::MatrixXd& covariance) {
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    covariance.row(i) = as_said(covariance.row(i), linear.row(i), answered.row(i));
  }
}

/// What the fit is made on: the thinned body, and what is measured, spread out first.
struct Asked {
  const ThinnedBody& thinned;
  Conditions conditions;  // at its nodes
  ShapeFunctions shape;
  std::vector<Eigen::Index> points;  // of Seen
  Points positions, displacement, sigma;

  Asked(const ThinnedBody& body, const Conditions& all)
      : thinned(body), conditions(subset(all, body.node)), shape(body.shape()) {
    const Seen seen(*all.measured);
    points = spread_out(seen.positions, seen.positions.rows());
    positions = seen.positions(points, Eigen::all);
    displacement = seen.displacement(points, Eigen::all);
    sigma = seen.sigma(points, Eigen::all);
  }

  /// places: what the rows see, the measured points first.
  Response response(const ShapeRows& rows, const Points& places) const {
    Response response = linear_response(thinned.stiff, conditions, rows);
    if (conditions.measured->registration_unknown) {
      response.rigid = rigid_motions(places, positions);
    }
    return response;
  }
};

/// Whether all of a node's displacement is prescribed and none of it measured.
bool is_held(const Conditions& conditions, Eigen::Index node) {
  return conditions.displacement.rows() > 0 && conditions.displacement.row(node).allFinite() &&
         !is_measured(conditions, node);
}

/// Displacements of the points of the cortex in place of the measured ones. E alone would leave some of the noise near
/// the rim, where the extension keeps within the measured values.
void impose(const Points& of_points, Conditions& conditions) {
  const Measurement& measured = *conditions.measured;
  if (!measured.extend) {
    conditions.displacement += measured.spread * (of_points - measured.cortex_displacement);
    return;
  }
  const Points extended = measured.extend(of_points);
  for (Eigen::Index a = 0; a < extended.rows(); ++a) {
    if (is_measured(conditions, a)) {
      conditions.displacement.row(a) = extended.row(a);
    }
  }
}

/// Lets a smooth motion of the opening move its points as they were measured, and all else as the body carries it; not
/// where the registration, which would share it, is unknown, or the weight is given.
void add_smooth_motion(const Asked& asked, const ShapeRows& rows, Response& response) {
  const Measurement& m = *asked.conditions.measured;
  if (m.registration_unknown || m.cortex.rows() == 0 || m.weight > 0) {
    return;
  }
  std::vector<Eigen::Index> on_cortex;  // rows
  for (std::size_t i = 0; i < asked.points.size(); ++i) {
    if (asked.points[i] < m.cortex.rows()) {
      on_cortex.push_back(static_cast<Eigen::Index>(i));
    }
  }
  const StiffBody& body = asked.thinned.stiff;
  const ShapeRows at_nodes = asked.shape.evaluate(body.cloud.positions, false);
  const Carried carried = carried_motion(body, asked.conditions, at_nodes, rows);
  const auto own = static_cast<Eigen::Index>(on_cortex.size());
  response.shortest = usual_distance(asked.positions(on_cortex, Eigen::all));
  response.sites = stacked(asked.positions(on_cortex, Eigen::all), body.cloud.positions(carried.nodes, Eigen::all));
  response.carry = Eigen::MatrixXd::Zero(response.compliance.rows(), 3 * response.sites.rows());
  response.carry.rightCols(carried.motion.cols()) = carried.motion;
  for (Eigen::Index i = 0; i < own; ++i) {
    auto row = response.carry.middleRows<3>(3 * on_cortex[static_cast<std::size_t>(i)]);
    row.setZero();
    row.middleCols<3>(3 * i).setIdentity();
  }
}

}  // namespace

MeasuredFit fit_measured(const ThinnedBody& thinned, const Conditions& conditions) {
  const Asked asked(thinned, conditions);
  const Measurement& measured = *conditions.measured;
  const Points places = stacked(asked.positions, within_sight(measured.asked, thinned.stiff.cloud.positions));
  const ShapeRows rows = inner_rows(asked.shape, places);
  Response response = asked.response(rows, places);
  add_smooth_motion(asked, rows, response);
  MeasuredFit fit = choose_weight(response, asked.displacement, asked.sigma, measured.weight);
  if (measured.asked.rows() > 0) {
    Posterior there = posterior(response, asked.displacement, asked.sigma, fit);
    fit.linear = std::move(there.mean);
    fit.covariance.resize(fit.linear.rows(), 6);
    for (Eigen::Index a = 0; a < fit.linear.rows(); ++a) {
      fit.covariance.row(a) = six_entries(there.covariance.block<3, 3>(3 * a, 3 * a));
    }
  }
  fit.motion_centre = asked.positions.colwise().mean().transpose();
  fit.motion_size = (asked.positions.rowwise() - fit.motion_centre.transpose()).rowwise().norm().mean();
  if (fit.smooth.length > 0) {
    Points smoothed = measured.cortex_displacement;  // of points that are there twice, as measured
    for (std::size_t i = 0; i < asked.points.size(); ++i) {
      if (asked.points[i] < smoothed.rows()) {
        smoothed.row(asked.points[i]) = fit.smoothed.row(static_cast<Eigen::Index>(i));
      }
    }
    fit.smoothed = std::move(smoothed);
  }
  return fit;
}

Conditions weighed_conditions(Conditions conditions, const MeasuredFit& fit) {
  Measurement& measured = *conditions.measured;
  measured.weight = fit.weight;
  if (fit.smooth.length > 0) {
    impose(fit.smoothed, conditions);
    measured.spread.setZero();
    if (measured.inner.rows() == 0) {
      conditions.measured.reset();
    }
  }
  return conditions;
}

void say_by_answer(const ThinnedBody& thinned, const Points& asked, const Points& displacement, MeasuredFit& fit) {
  if (asked.rows() == 0) {
    return;
  }
  const ShapeFunctions shape = thinned.shape();
  const ShapeRows rows = inner_rows(shape, within_sight(asked, thinned.stiff.cloud.positions));
  say(fit.linear, answered_at(rows, thinned, shape, displacement), fit.covariance);
}

Eigen::MatrixXd measured_covariance(const Model& model, const SolveOptions& options, const MeasuredFit& fit,
                                    const Points& displacement) {
  const ThinnedBody thinned = thinned_body(model, options.shape);
  const Asked asked(thinned, model.conditions);
  ShapeRows rows = inner_rows(asked.shape, asked.positions);
  append_nodes(thinned.node.size(), rows);
  const Points places = stacked(asked.positions, thinned.stiff.cloud.positions);
  Response response = asked.response(rows, places);
  add_smooth_motion(asked, rows, response);
  const Posterior of_nodes = posterior(response, asked.displacement, asked.sigma, fit);
  const ShapeRows at_all = inner_rows(asked.shape, model.cloud.positions);
  Eigen::MatrixXd covariance = covariance_of(at_all, of_nodes.covariance);
  say(values_of(at_all, of_nodes.mean), answered_at(at_all, thinned, asked.shape, displacement), covariance);
  for (Eigen::Index a = 0; a < covariance.rows(); ++a) {
    if (is_held(model.conditions, a)) {
      covariance.row(a).setZero();  // a ball about it reaches past the body
    }
  }
  return covariance;
}

std::vector<Outlier> outliers(const ThinnedBody& thinned, const Conditions& conditions) {
  const Asked asked(thinned, conditions);
  // Without a smooth motion: one alike over short lengths takes a wrong point for one of its own.
  const Response response = asked.response(inner_rows(asked.shape, asked.positions), asked.positions);
  const Trust trust = robust_trust(response, asked.displacement, asked.sigma, conditions.measured->weight);
  std::vector<Outlier> found;
  for (Eigen::Index i = 0; i < trust.surprise.size(); ++i) {
    if (trust.surprise[i] > surprising) {
      found.push_back({asked.positions.row(i), trust.surprise[i]});
    }
  }
  std::ranges::sort(found, std::greater(), &Outlier::deviations);
  return found;
}

LessenedPoints lessen_outliers(Model& model, const SolveOptions& options, const OpeningOptions& opening) {
  check_parts(model, options);
  const ThinnedBody thinned = thinned_body(model, options.shape);
  const Seen seen(*model.conditions.measured);
  const double weight = model.conditions.measured->weight;
  const Response response = linear_response(thinned.stiff, subset(model.conditions, thinned.node),
                                            inner_rows(thinned.shape(), seen.positions));
  const Eigen::VectorXd trust = robust_trust(response, seen.displacement, seen.sigma, weight).weight;
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
  const ThinnedBody thinned = thinned_body(model, options.shape);
  MeasuredFit fit = fit_measured(thinned, model.conditions);
  Model weighed = model;
  weighed.conditions = weighed_conditions(model.conditions, fit);
  SolveResult result = solve_whole_body(weighed, options, progress);
  say_by_answer(thinned, model.conditions.measured->asked, result.solution.displacement, fit);
  result.measures.measured = std::move(fit);
  return result;
}

}  // namespace brainshift::solve
