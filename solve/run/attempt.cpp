// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/attempt.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "segmentation/geometry/quantile.hpp"
#include "segmentation/progress/stopwatch.hpp"
#include "solve/body/nodal_order.hpp"
#include "solve/output/field_difference.hpp"
#include "solve/run/coarse.hpp"
#include "solve/run/error_estimate.hpp"
#include "solve/run/prepare.hpp"
#include "solve/run/step.hpp"
#include "solve/run/thin_parts.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

bool ends_alike(const Model& model, const SolveOptions& options) {
  return options.dynamics == Dynamics::relaxation && model.cuts.empty() && !model.rupture &&
         model.curve.at(model.curve.duration()) == 1;
}

namespace {

/// Whether nobody wants to see the way to the end, either.
bool may_start_near(const Model& model, const SolveOptions& options) {
  return options.start == Start::coarse && options.snapshot_every == 0 && ends_alike(model, options);
}

}  // namespace

/// In the plane it is not: a strip pressed by a quarter at ν = 0.499 folded on the way from it.
bool starts_coarse(const Model& model, const SolveOptions& options) {
  return may_start_near(model, options) && model.plane == Plane::none && !model.septum && !model.resection;
}

SolveOptions of_coarse_start(SolveOptions options) {
  constexpr double factor = 0.5;  // so that what it leaves open, left_by_coarse(), is below what is wanted
  options.tolerance *= factor;
  options.load_steps = std::min(options.load_steps, 100);
  return options;
}

bool too_thin_for_quadratic(const SolveOptions& options, const SolveMeasures& measures) {
  return options.shape.basis == Basis::modified_quadratic && 2 * measures.grown_supports > measures.integration_points;
}

void put_first(const std::string& what, std::string& took) {
  took = what + (took.empty() ? "" : "; " + took);
}

namespace {

/// The displacement of the last state at the body's nodes; nothing where they cannot be told apart: face nodes of a
/// septum lie in pairs at one place.
std::optional<Points> last_displacement(const Model& model, const Points& positions) {
  const Solution& last = *model.last;
  if (last.positions.rows() == positions.rows() && last.positions == positions) {
    return as_prescribed(last.displacement, model);
  }
  if (model.septum || !last.cut.empty()) {
    return std::nullopt;
  }
  return as_prescribed(displacement_at(last, positions), model);
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

/// A body that creases has more than one state at rest, and only the way of the load leads to the one that it takes. A
/// bonded slab of two spacings, pressed by a quarter, is 18 of 38 mm off else.
bool is_creased(const SolveResult& result) {
  return result.measures.compressed_share >= much_compressed;
}

/// What is left of the bound of a coarse start, mm: where it took more steps to its rest than came after it, its
/// slowest motions have hardly moved since, and the fine body's bound does not see them. A cube turned by three of its
/// nodes ends 0.0025 mm off after 220 steps, from rest after 19,200, at a bound of its own of 0.0005.
double left_by_coarse(const CoarseSolution& coarse, const SolveMeasures& fine) {
  return coarse.steps > fine.steps ? coarse.error_bound : 0;
}

/// û under the full load to start from, in the body's order; empty: from rest.
NodalVectors near_start(const Model& model, const SolveOptions& options, const std::optional<CoarseSolution>& coarse,
                        const Body& body) {
  if (model.last && may_start_near(model, options)) {
    if (const std::optional<Points> last = last_parameters(model, options, body)) {
      return in_body_order(*last, body.original);
    }
  }
  return coarse ? in_body_order(coarse->displacement, body.original) : NodalVectors();
}

/// coarse: where it was solved to start from, if it came to rest. A tear's way hangs on single nodes: there is none on
/// others to hold it against.
void estimate_error(const Model& model, const SolveOptions& options, std::optional<CoarseSolution> coarse,
                    SolveResult& result, const Progress& progress) {
  if (model.rupture) {
    return;
  }
  const Stopwatch begin;
  SolveOptions of_coarse = of_coarse_start(options);
  if (model.septum) {  // a coarse cloud may slide along it for tens of thousands of steps
    constexpr int times = 3, least = 1000;
    of_coarse.max_steps = std::min(options.max_steps, std::max(least, times * result.measures.steps));
  }
  if (!coarse && !starts_coarse(model, options)) {
    const auto wait = [&](double, std::string_view) { report(progress, 1, "estimating the error on a coarse cloud"); };
    coarse = coarse_solution(model, of_coarse, wait);
  }
  if (!coarse) {
    coarse = less_coarse_solution(model, of_coarse, {});
  }
  result.measures.seconds_coarse += begin.seconds();
  if (coarse) {
    result.solution.estimated_error = estimated_error(result.solution, coarse->displacement, coarse->wider);
    result.measures.estimated_error_95 = quantile(result.solution.estimated_error, 0.95);
  }
}

}  // namespace

SolveResult attempt(const Model& model, const SolveOptions& options, const SolveMeasures& known,
                    const Progress& progress) {
  const auto with = [&](const SolveOptions& other, const std::string& what) {
    SolveResult result = attempt(model, other, known, progress);
    put_first(what, result.measures.took);
    return result;
  };
  const Stopwatch start;
  SolveMeasures measures = known;
  Prepared prepared = prepare(model, options, {}, measures, progress);
  if (too_thin_for_quadratic(options, measures)) {
    SolveOptions linear = options;
    linear.shape.basis = Basis::linear;
    return with(linear, "linear shape functions, as the cloud is too thin for quadratic ones");
  }
  measures.seconds_setup = start.seconds();
  std::optional<CoarseSolution> coarse;
  if (starts_coarse(model, options)) {
    const Stopwatch begin;
    report(progress, 0, "solving a coarse cloud");
    coarse = coarse_solution(model, of_coarse_start(options), {});
    measures.seconds_coarse = begin.seconds();
  }
  NodalVectors near = near_start(model, options, coarse, prepared.body);
  const bool from_rest = near.empty();
  measures.thin = thin_parts(model, prepared.body.placed);
  const std::optional<InsideBody> inside = prepared.cut ? std::optional(prepared.cut->inside) : std::nullopt;
  SolveResult result = step_to_end(model, options, std::move(prepared), measures, std::move(near), progress);
  if (!from_rest && result.failure.empty() && is_creased(result)) {
    report(progress, 0, "tissue creases; once more from rest");
    SolveOptions rest = options;
    rest.start = Start::rest;
    return with(rest, "the load from rest, as the tissue creases");
  }
  if (inside) {
    draw_faces(*inside, result);
  }
  if (result.failure.empty()) {
    if (coarse) {
      result.measures.error_bound = std::max(result.measures.error_bound, left_by_coarse(*coarse, result.measures));
    }
    estimate_error(model, options, std::move(coarse), result, progress);
  }
  return result;
}

}  // namespace brainshift::solve
