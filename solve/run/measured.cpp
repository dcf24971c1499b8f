// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/measured.hpp"

#include <utility>

#include "solve/interface/unfit_parts.hpp"
#include "solve/measured/inner_rows.hpp"
#include "solve/measured/weight.hpp"
#include "solve/run/measured_covariance.hpp"
#include "solve/run/measured_points.hpp"
#include "solve/run/whole_body.hpp"

namespace brainshift::solve {

namespace {

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

}  // namespace

void check_measured(const Model& model, const SolveOptions& options) {
  std::vector<UnfitPart> unfit = beyond_rest(model, options);
  unfit.insert(unfit.begin() + 1, {options.imposition == Imposition::simplified, "the simplified imposition"});
  refuse_unfit("a load with noise does not go", unfit, "leave the one or the other out");
}

MeasuredFit fit_measured(const ThinnedBody& thinned, const Conditions& conditions) {
  const MeasuredPoints points(thinned, conditions);
  const Measurement& measured = *conditions.measured;
  const Points places = stacked(points.positions, within_sight(measured.asked, thinned.stiff.cloud));
  const Response response = points.response_and_motion(inner_rows(points.shape, places), places);
  MeasuredFit fit = choose_weight(response, points.displacement, points.sigma, measured.weight);
  if (measured.asked.rows() > 0) {
    add_posterior(points, response, fit);
  }
  fit.motion_centre = points.positions.colwise().mean().transpose();
  fit.motion_size = (points.positions.rowwise() - fit.motion_centre.transpose()).rowwise().norm().mean();
  if (fit.smooth.length > 0) {
    Points smoothed = measured.cortex_displacement;  // of points that are there twice, as measured
    for (std::size_t i = 0; i < points.row.size(); ++i) {
      if (points.row[i] < smoothed.rows()) {
        smoothed.row(points.row[i]) = fit.smoothed.row(static_cast<Eigen::Index>(i));
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

SolveResult solve_measured(const Model& model, const SolveOptions& options, const Progress& progress) {
  check_measured(model, options);
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
