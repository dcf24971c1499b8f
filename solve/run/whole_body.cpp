// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/whole_body.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "segmentation/progress/stopwatch.hpp"
#include "solve/body/nodal_order.hpp"
#include "solve/cut/resection.hpp"
#include "solve/output/field_difference.hpp"
#include "solve/run/coarse.hpp"
#include "solve/run/error_estimate.hpp"
#include "solve/run/prepare.hpp"
#include "solve/run/step.hpp"
#include "solve/run/thin_parts.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

namespace {

struct Attempt {
  SolveOptions options;
  std::string what;
};

/// Whether nobody wants to see the way to the end, nor does the end depend on it.
bool may_start_near(const Model& model, const SolveOptions& options) {
  return options.start == Start::coarse && options.dynamics == Dynamics::relaxation && options.snapshot_every == 0 &&
         model.cuts.empty() && !model.rupture && model.curve.at(model.curve.duration()) == 1;
}

/// Whether a coarse solution is made: as the start, or to tell the error.
bool has_coarse(const Model& model, const SolveOptions& options) {
  return may_start_near(model, options) && !model.septum && !model.resection;
}

}  // namespace

/// In the plane it is not: a strip pressed by a quarter at ν = 0.499 folded on the way from it.
bool starts_coarse(const Model& model, const SolveOptions& options) {
  return has_coarse(model, options) && model.plane == Plane::none;
}

SolveOptions of_coarse_start(SolveOptions options) {
  constexpr double factor = 5;  // what a coarse solution is wrong by is more
  options.tolerance *= factor;
  options.load_steps = std::min(options.load_steps, 100);
  return options;
}

bool too_thin_for_quadratic(const SolveOptions& options, const SolveMeasures& measures) {
  return options.shape.basis == Basis::modified_quadratic && 2 * measures.grown_supports > measures.integration_points;
}

bool is_confined(const Model& model) {
  for (std::size_t a = 0; a < model.cloud.size(); ++a) {
    const auto node = static_cast<Eigen::Index>(a);
    const bool held = model.conditions.is_prescribed(node, 0) && model.conditions.is_prescribed(node, 1) &&
                      (model.plane != Plane::none || model.conditions.is_prescribed(node, 2));
    if (model.cloud.on_surface[a] != 0 && !held) {
      return false;
    }
  }
  return !model.conditions.measured;
}

namespace {

/// What the body is tried with after this result, in this order: none makes the answer looser.
std::vector<Attempt> further_attempts(const SolveResult& result, const SolveOptions& options) {
  constexpr int slower = 5;
  Attempt doubled{.options = options, .what = "double precision"};
  doubled.options.precision = Precision::double_precision;
  if (result.rounded) {
    return {doubled};
  }
  if (!result.unstable) {
    return {};
  }
  std::vector<Attempt> attempts(2, {.options = options, .what = {}});
  attempts.push_back(doubled);
  for (Attempt& attempt : attempts) {
    attempt.options.start = Start::rest;
    attempt.options.load_steps *= slower;
    attempt.what =
        std::to_string(attempt.options.load_steps) + " load steps" + (attempt.what.empty() ? "" : ", " + attempt.what);
  }
  attempts[1].options.shape.basis = Basis::linear;
  attempts[1].what += ", linear shape functions";
  if (options.precision == Precision::double_precision) {
    attempts.pop_back();
  }
  return attempts;
}

/// Above some contrast of stiffness a slower load ends, but with an answer that is several times too stiff (measured:
/// two layers of 1 : 10⁶).
bool may_be_tried_again(const Model& model, const SolveOptions& options) {
  constexpr double most_contrast = 1e5;
  return options.dynamics == Dynamics::relaxation && !model.rupture &&
         stiffness_contrast(model.materials) <= most_contrast;
}

/// The displacement of the last state at the body's nodes; nothing where they cannot be told apart: face nodes of a
/// septum lie in pairs at one place.
std::optional<Points> last_displacement(const Model& model, const Points& positions) {
  const Solution& last = *model.last;
  if (last.positions.rows() == positions.rows() && last.positions == positions) {
    return as_prescribed(last.displacement, model.conditions);
  }
  if (model.septum || !last.cut.empty()) {
    return std::nullopt;
  }
  return as_prescribed(displacement_at(last, positions), model.conditions);
}

/// û of the last state, cloud's order. Shape functions beside a septum see one side of it alone: there u is near
/// enough.
std::optional<Points> last_parameters(const Model& model, const SolveOptions& options, const Body& body) {
  try {
    const std::optional<Points> u = last_displacement(model, body.positions);
    if (!u || model.septum) {
      return u;
    }
    return parameters_from_displacement({body.positions, body.spacing, options.shape}, body.positions, *u);
  } catch (const std::logic_error&) {
    return std::nullopt;  // it has too few nodes near one of these
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

SolveResult attempt(const Model& model, const SolveOptions& options, const SolveMeasures& known,
                    const Progress& progress) {
  constexpr std::size_t few_nodes = 500;
  const Stopwatch start;
  SolveMeasures measures = known;
  Prepared prepared = prepare(model, options, {}, measures, progress);
  if (too_thin_for_quadratic(options, measures)) {
    SolveOptions linear = options;
    linear.shape.basis = Basis::linear;
    SolveResult result = attempt(model, linear, known, progress);
    result.measures.took = "linear shape functions, as the cloud is too thin for quadratic ones";
    return result;
  }
  measures.seconds_setup = start.seconds();
  std::optional<Points> coarse;
  NodalVectors start_from;
  if (has_coarse(model, options)) {
    const Stopwatch begin;
    report(progress, 0, "solving a coarse cloud");
    coarse = coarse_displacement(model, of_coarse_start(options), {});
    if (coarse && starts_coarse(model, options)) {
      start_from = in_body_order(*coarse, prepared.body.original);
    }
    measures.seconds_coarse = begin.seconds();
  }
  if (model.last && may_start_near(model, options)) {
    if (const std::optional<Points> last = last_parameters(model, options, prepared.body)) {
      start_from = in_body_order(*last, prepared.body.original);
    }
  }
  const PlacedPoints placed = model.cloud.size() < few_nodes ? prepared.body.placed : PlacedPoints();
  SolveResult result = step_to_end(model, options, std::move(prepared), measures, std::move(start_from), progress);
  if (coarse && result.failure.empty()) {
    result.solution.estimated_error = estimated_error(model.cloud, result.solution.displacement, *coarse);
    result.measures.estimated_error_95 = percentile_95(result.solution.estimated_error);
  }
  result.measures.thin = thin_parts(model, placed);
  return result;
}

/// Under a high pressure what patches leave to their points alone gives way: of −9 % of volume at ν = 0.499 two thirds
/// of the displacement are wrong. Pointwise it is exact, and cannot lock, as nothing bulges.
std::optional<SolveResult> attempt_pointwise(const Model& model, const SolveOptions& options, const SolveResult& result,
                                             const SolveMeasures& known, const Progress& progress) {
  if (result.measures.pressed_share < much_pressed || !is_confined(model)) {
    return std::nullopt;
  }
  report(progress, 0, "under high pressure; once more with pointwise dilatation");
  SolveOptions pointwise = options;
  pointwise.volumetric = Volumetric::pointwise;
  SolveResult next = attempt(model, pointwise, known, progress);
  if (!next.failure.empty()) {
    return std::nullopt;
  }
  next.measures.took = "pointwise dilatation, as the volume that is prescribed puts the tissue under high pressure";
  return next;
}

}  // namespace

SolveResult solve_whole_body(const Model& model, const SolveOptions& given, const Progress& progress) {
  const SolveOptions options = completed(given, model);
  SolveMeasures measures;
  std::optional<Resected> resected;
  if (model.resection) {
    resected = resect(model, options);
    measures.resection = resected->measures;
  }
  const Model& solved = resected ? resected->rest : model;
  SolveResult result = attempt(solved, options, measures, progress);
  if (std::optional<SolveResult> pointwise = attempt_pointwise(solved, options, result, measures, progress)) {
    return std::move(*pointwise);
  }
  const std::vector<Attempt> attempts = further_attempts(result, options);
  if (attempts.empty() || !may_be_tried_again(solved, options)) {
    return result;
  }
  for (const auto& [other, what] : attempts) {
    report(progress, 0, "not at rest; once more with " + what);
    SolveResult next = attempt(solved, other, measures, progress);
    if (!next.unstable && !next.rounded) {
      next.measures.took = what;
      return next;
    }
  }
  result.failure += result.unstable ? "; a load five times as slow did not help, nor did linear shape functions" : "";
  return result;
}

}  // namespace brainshift::solve
