// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/update/kept_run.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <stdexcept>

#include "segmentation/progress/stopwatch.hpp"
#include "solve/body/check_model.hpp"
#include "solve/body/nodal_order.hpp"
#include "solve/body/ordered_cloud.hpp"
#include "solve/device/backend.hpp"
#include "solve/device/kept_on_device.hpp"
#include "solve/dynamics/relaxation.hpp"
#include "solve/run/completed.hpp"
#include "solve/run/measured.hpp"
#include "solve/run/measured_covariance.hpp"
#include "solve/run/prepare.hpp"
#include "solve/run/step.hpp"
#include "solve/shape/nodal_displacement.hpp"
#include "solve/shape/shape_functions.hpp"
#include "solve/update/other_load.hpp"

namespace brainshift::solve {

namespace {

constexpr double closer_at_rest = 0.1;  // of the tolerance: what is open here every answer begins with

/// A_0 of what responses leave open: it is local. Lower takes more steps; at a higher one nodes that slide along the
/// skull end farther off.
constexpr double local_eigenvalue = 0.0025;
constexpr double farther_eigenvalue = 0.0015;  // where other nodes are loaded

/// A_0 of heads that rock in their fluid is 2e-5 to 4e-5, of others 1.2e-4 and more. A response would not come to rest
/// in the steps that it is worth, and without any an update is a relaxation as a run's, whose looks are for slow
/// bodies.
constexpr double slow_body = 8e-5;

/// Takes over where a body has come to rest.
void take(SteppingResult& stepped, KeptBody& kept) {
  kept.body = std::move(stepped.body);
  kept.parameters = std::move(stepped.parameters);
  kept.settled = std::move(stepped.settled);
}

/// What the new load moves the loaded nodes by, from what was prescribed before or, of nodes that were free, from where
/// they came to rest; 0 elsewhere.
Points change_of(const Points& prescribed, const Points& before, const Points& displacement) {
  Points change = Points::Zero(prescribed.rows(), 3);
  for (Eigen::Index i = 0; i < prescribed.size(); ++i) {
    if (!std::isnan(prescribed.data()[i])) {
      const double from = std::isnan(before.data()[i]) ? displacement.data()[i] : before.data()[i];
      change.data()[i] = prescribed.data()[i] - from;
    }
  }
  return change;
}

/// Whether responses tell all of a load's change to first order: they are known, and it is exact and prescribes what
/// the run's own load did.
bool responses_tell(const KeptRun& run, const Conditions& load) {
  return run.responses.count() > 0 && !load.measured &&
         (load.displacement.array().isNaN() == run.origin.prescribed.array().isNaN()).all();
}

/// Masses and damping of an answer's steps; nothing of a slow body, of one that was laid out anew, or of a change that
/// is too large to be sure that what is left open is local. change: of what is prescribed, from the run's own load, mm.
std::optional<Settled> settled_for(const Conditions& load, const Points& change, bool tells_all, const KeptRun& run) {
  const bool anew = run.prepared_for.rows() == 0;
  if (anew || run.origin.lowest <= slow_body || run.trusted <= 0 || change.rowwise().norm().maxCoeff() > run.trusted) {
    return std::nullopt;
  }
  Settled settled = run.fine.settled;
  settled.lowest = run.origin.lowest;
  if (run.responses.count() > 0 && !load.measured) {
    settled.of_rigid = settled.lowest;
    settled.lowest = std::max(settled.lowest, tells_all ? local_eigenvalue : farther_eigenvalue);
  }
  return settled;
}

/// û by the first order from the run's own load; where the responses do not tell all, from the last load where that is
/// nearer.
NodalVectors first_order(const Points& prescribed, const Points& from_origin, bool tells_all, const KeptRun& run) {
  const Points from_last = change_of(prescribed, run.prescribed, run.displacement);
  const bool last = !tells_all && from_last.norm() <= from_origin.norm();
  return answered(last ? run.fine.parameters : run.origin.parameters, run.responses, last ? from_last : from_origin);
}

/// A load of no node at all is one of points inside alone.
Conditions with_all_rows(Conditions load, Eigen::Index nodes) {
  if (load.displacement.rows() == 0) {
    load.displacement = Points::Constant(nodes, 3, std::nan(""));
  }
  return load;
}

void check_is_held(const Conditions& load, const Body& body) {
  OrderedCloud cloud;
  cloud.positions = body.positions;
  cloud.conditions = load;
  check_held(cloud, Plane::none, body.contact.has_value(), !body.external.empty());
}

void check_same_opening(const Points& before, const Points& now) {
  std::size_t both = 0, either = 0;
  for (Eigen::Index a = 0; a < before.rows(); ++a) {
    const bool was = is_loaded(before, a), is = is_loaded(now, a);
    both += was && is ? 1 : 0;
    either += was || is ? 1 : 0;
  }
  if (2 * both < either) {
    throw std::invalid_argument("its points lie elsewhere than those of the run: of " + std::to_string(either) +
                                " nodes under one of the two openings " + std::to_string(both) +
                                " lie under both; a new opening needs a new run");
  }
}

SolveMeasures sizes_of(const KeptRun& run, const Points& prescribed) {
  const PointBlocks& points = run.fine.body.points;
  SolveMeasures measures;
  measures.nodes = run.fine.body.nodes();
  measures.integration_points = points.points();
  measures.pairs = std::accumulate(points.support.begin(), points.support.end(), std::size_t{0});
  measures.mean_support = static_cast<double>(measures.pairs) / static_cast<double>(points.points());
  measures.single_precision = points.precision() == Precision::single_precision;
  measures.loaded_nodes = loaded_nodes(prescribed).size();
  return measures;
}

/// At rest once more, closer than a run comes, from where it lay.
SteppingResult rest_of(const Model& model, const SolveOptions& options, const Points& displacement,
                       const Progress& progress) {
  SolveMeasures measures;
  Prepared prepared = prepare(model, options, {}, measures, progress);
  const ShapeFunctions shape(model.cloud.positions, model.cloud.spacing, options.shape);
  const Points parameters = parameters_from_displacement(shape, model.cloud.positions, displacement);
  const Course course{
      .curve = model.curve, .start = in_body_order(parameters, prepared.body.original), .bound = BoundOf::parameters};
  SolveOptions closer = options;
  closer.tolerance *= closer_at_rest;
  return relax(std::move(prepared.body), course, closer, progress);
}

/// relax(), on the device that the options want.
SteppingResult come_to_rest(KeptRun& run, const Course& course, const Progress& progress) {
  RelaxElsewhere elsewhere;
  if (run.options.device != Device::cpu) {
    if (!run.on_device) {
      run.on_device = std::make_shared<device::KeptOnDevice>(device::gpu());
    }
    elsewhere = std::bind_front(&device::KeptOnDevice::relax_if_asked, run.on_device.get());
  }
  return relax(std::move(run.fine.body), course, run.options, progress, elsewhere);
}

}  // namespace

std::string cannot_keep(const Model& model, const SolveOptions& options) {
  if (!model.cuts.empty() || model.rupture) {
    return "it has cuts or may tear";
  }
  if (model.septum || model.resection) {
    return model.septum ? "it has falx or tentorium" : "it has a resection";
  }
  if (model.conditions.measured && model.conditions.measured->registration_unknown) {
    return "its registration is unknown";
  }
  if (options.dynamics != Dynamics::relaxation || options.region > 0) {
    return options.region > 0 ? "it solves a region alone" : "it is a motion in time";
  }
  if (model.conditions.at_nodes_alone) {
    return "it is held at its nodes alone";
  }
  if (model.plane != Plane::none || options.imposition != Imposition::exact) {
    return model.plane != Plane::none ? "it is a plane problem" : "its conditions are imposed in the simplified form";
  }
  return model.curve.at(model.curve.duration()) == 1 ? "" : "its load's curve does not end at 1";
}

KeptRun keep(const Model& solved, const SolveOptions& given, const Points& displacement, const Progress& progress) {
  const std::string why = cannot_keep(solved, given);
  if (!why.empty()) {
    throw std::invalid_argument("the run cannot be updated: " + why);
  }
  if (displacement.rows() != solved.cloud.positions.rows()) {
    throw std::invalid_argument("the run cannot be updated: its solution has " + std::to_string(displacement.rows()) +
                                " nodes, its cloud " + std::to_string(solved.cloud.positions.rows()));
  }
  std::optional<ThinnedBody> thinned;
  std::optional<Model> weighed;
  if (solved.conditions.measured) {
    thinned = thinned_body(solved, given.shape);
    weighed = solved;
    weighed->conditions = weighed_conditions(solved.conditions, fit_measured(*thinned, solved.conditions));
  }
  const Model& model = weighed ? *weighed : solved;
  SolveOptions options = completed(given, model);
  SteppingResult stepped = rest_of(model, options, displacement, progress);
  if (stepped.rounded) {  // a brain in much fluid, which little holds
    options.precision = Precision::double_precision;
    stepped = rest_of(model, options, displacement, progress);
  }
  if (!stepped.failure.empty()) {
    throw std::invalid_argument("the run does not come to rest once more: " + stepped.failure);
  }
  KeptRun run{.options = options,
              .on_surface = model.cloud.on_surface,
              .prescribed = with_all_rows(model.conditions, displacement.rows()).displacement,
              .displacement = nodal_displacement(stepped.body.nodal_rows, stepped.parameters, stepped.body.original),
              .fine = {},
              .origin = {},
              .prepared_for = {},
              .responses = {},
              .departures = {},
              .thinned = std::move(thinned)};
  take(stepped, run.fine);
  run.origin = {run.fine.parameters, run.prescribed, run.displacement, run.fine.settled.lowest};
  run.prepared_for = run.prescribed;
  if (!model.conditions.measured && run.origin.lowest > slow_body) {
    run.responses = responses_of(run.fine, run.prescribed, options, progress);
  }
  if (run.origin.lowest > slow_body) {
    run.trusted = trusted_change(run, with_all_rows(solved.conditions, displacement.rows()), progress);
  }
  return run;
}

SolveResult update(KeptRun& run, const Conditions& given, const Progress& progress) {
  check_conditions(given, static_cast<std::size_t>(run.displacement.rows()));
  Conditions load = with_all_rows(given, run.displacement.rows());
  check_same_opening(run.origin.prescribed, load.displacement);
  check_is_held(load, run.fine.body);
  std::optional<MeasuredFit> fit;
  if (load.measured) {
    if (!run.thinned) {
      throw std::invalid_argument("it has standard deviations, but the run's load was met exactly");
    }
    thin_for(load, run);
    fit = fit_measured(*run.thinned, load);
    load = weighed_conditions(std::move(load), *fit);
  }
  const Points& prescribed = load.displacement;
  SolveMeasures measures = sizes_of(run, prescribed);
  measures.measured = std::move(fit);
  const Stopwatch stepping;
  const Points from_origin = change_of(prescribed, run.origin.prescribed, run.origin.displacement);
  const bool tells_all = responses_tell(run, load);
  const NodalVectors told = first_order(prescribed, from_origin, tells_all, run);
  Course course;
  course.start = told;
  if (!is_prepared_for(prescribed, run)) {
    prepare_for(load, run, progress);
  }
  course.settled = settled_for(load, from_origin, tells_all, run);
  course.bound = run.options.device == Device::cpu ? BoundOf::displacement : BoundOf::parameters;
  if (tells_all) {
    run.departures.add_expected(run.responses, from_origin, course.start);
  }
  set_load(load, run);
  SteppingResult stepped = come_to_rest(run, course, progress);
  if (!stepped.failure.empty() && course.settled && std::isfinite(run.trusted)) {  // a trial is to see it fail
    run.fine.body = std::move(stepped.body);
    course.settled.reset();
    course.start = told;
    stepped = come_to_rest(run, course, progress);
  }
  if (!stepped.failure.empty()) {
    stepped.failure += "; run the scene with this load instead";
  }
  SolveResult result = result_of(stepped, run.options, measures);
  result.measures.seconds_stepping = stepping.seconds();
  if (result.measures.measured) {
    say_by_answer(*run.thinned, given.measured->asked, result.solution.displacement, *result.measures.measured);
  }
  take(stepped, run.fine);
  if (tells_all && result.failure.empty()) {
    run.departures.learn(run.responses, from_origin, told, run.fine.parameters, result.measures.error_bound);
  }
  run.prescribed = run.prepared_for = prescribed;
  run.displacement = result.solution.displacement;
  return result;
}

}  // namespace brainshift::solve
