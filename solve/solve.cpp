// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solve.hpp"

#include <algorithm>
#include <chrono>
#include <sstream>

#include "solve/cut/dissection.hpp"
#include "solve/cut/resection.hpp"
#include "solve/dynamics/diagnosis.hpp"
#include "solve/dynamics/relaxation.hpp"
#include "solve/dynamics/transient.hpp"
#include "solve/nodal_displacement.hpp"
#include "solve/ordered_cloud.hpp"
#include "solve/prepare.hpp"
#include "solve/region/coarse.hpp"
#include "solve/region/region.hpp"

namespace brainshift::solve {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

HeldBytes held_bytes(const Prepared& p, HeldBytes stepping) {
  stepping.shape_functions = p.points.shape_bytes() + p.nodal_rows.held_bytes() + p.placed.held_bytes();
  stepping.nodal_vectors += bytes(p.mass) + bytes(p.original) + bytes(p.start);
  stepping.pressure_patches = bytes(p.points.mode);
  stepping.essential_conditions = p.essential.held_bytes();
  stepping.contact = (p.contact ? p.contact->held_bytes() : 0) + (p.face_contact ? p.face_contact->held_bytes() : 0);
  stepping.external_forces = bytes(p.external);
  stepping.cuts = (p.cut ? p.cut->held_bytes() : 0) + (p.pieces ? p.pieces->held_bytes() : 0);
  return stepping;
}

/// What the end state says of itself; sets a failure that stepping does not see.
void measure(const Prepared& p, const SteppingResult& stepped, SolveMeasures& m, std::string& failure) {
  m.steps = stepped.steps;
  m.error_bound = stepped.error_bound;
  m.critical_step = stepped.critical_step;
  m.constraint_error = p.essential.largest_error(stepped.fraction, stepped.parameters);
  if (p.contact) {
    const Contact::Measures touch = p.contact->measure(stepped.parameters);
    m.contact_nodes = touch.touching;
    m.largest_penetration = touch.largest_penetration;
    if (touch.lost && failure.empty()) {
      std::ostringstream text;
      text << "the surface passed through the skull, by " << touch.largest_penetration
           << " mm or more: the load comes too fast; spread it over more steps";
      failure = text.str();
    }
  }
  m.converged = failure.empty();
  m.smallest_jacobian = stepped.state.smallest_jacobian;
  m.largest_stretch = stepped.state.largest_stretch;
  m.compressed_share = stepped.state.compressed_share;
  m.bytes = held_bytes(p, stepped.held);
}

bool starts_coarse(const Model& model, const SolveOptions& options) {
  return options.start == Start::coarse && options.dynamics == Dynamics::relaxation && options.snapshot_every == 0 &&
         model.plane == Plane::none && model.cuts.empty() && !model.rupture && !model.resection &&
         model.curve.at(model.curve.duration()) == 1;
}

/// The coarse solution's displacement at the nodes, taken for their parameters: near enough for a start.
NodalVectors coarse_start(const Model& model, SolveOptions options, const std::vector<std::int32_t>& original) {
  constexpr double looser = 5;  // what a coarse solution is wrong by is more
  options.tolerance *= looser;
  options.load_steps = std::min(options.load_steps, 100);
  NodalVectors start;
  if (const std::optional<Points> displacement = coarse_displacement(model, options, {})) {
    start.resize(4 * original.size(), 0.0);
    for (std::size_t a = 0; a < original.size(); ++a) {
      at(start, a).head<3>() = displacement->row(original[a]);
    }
  }
  return start;
}

CutMeasures measure_cut(const Prepared& p, const SteppingResult& stepped, std::size_t nodes, CutMeasures measures) {
  measures.split_nodes = p.cut->split;
  measures.added_nodes = p.cut->cloud.size() - nodes;
  measures.extent = p.cut->visibility ? extent(p.cut->visibility->facets()) : 0;
  if (p.face_contact) {
    const FaceContact::Measures touch = p.face_contact->measure(stepped.parameters);
    measures.faces = {touch.touching, touch.largest_overlap};
  }
  return measures;
}

}  // namespace

SolveResult step(const Model& model, const SolveOptions& options, Prepared prepared, SolveMeasures measures,
                 const Progress& progress) {
  const auto start = Clock::now();
  Prepared& p = prepared;
  std::optional<Dissection> dissection;
  if (p.pieces) {
    dissection.emplace(model, options, p);
  }
  const System system{p.points,
                      p.laws,
                      p.essential,
                      p.contact ? &*p.contact : nullptr,
                      p.external,
                      model.curve,
                      p.nodal_rows,
                      p.original,
                      dissection ? &*dissection : nullptr,
                      p.face_contact ? &*p.face_contact : nullptr,
                      p.start.empty() ? nullptr : &p.start};
  SteppingResult stepped = options.dynamics == Dynamics::relaxation ? relax(system, options, progress)
                                                                    : march(system, p.prony, p.mass, options, progress);
  const NodeCloud& cloud = p.cut ? p.cut->cloud : model.cloud;
  SolveResult result;
  result.measures = measures;
  result.failure = stepped.failure;
  measure(p, stepped, result.measures, result.failure);
  if (stepped.fault) {
    result.failure += ' ';
    result.failure += describe(*stepped.fault, {p.points, p.laws, cloud.positions, p.original, p.placed});
  }
  result.history = std::move(stepped.history);
  constexpr double newton = 1e-6;  // µN to N
  result.solution = {cloud.positions,
                     nodal_displacement(p.nodal_rows, stepped.parameters, p.original),
                     newton * in_original_order(stepped.reactions, p.original),
                     cloud.spacing,
                     options.shape,
                     p.cut && p.cut->visibility ? p.cut->visibility->facets() : CutFacets()};
  result.snapshots = std::move(stepped.snapshots);
  if (p.cut) {
    result.inside = p.cut->inside;
  }
  if (p.cut) {
    result.measures.cut =
        measure_cut(p, stepped, model.cloud.size(), dissection ? dissection->measures() : CutMeasures());
  }
  result.measures.largest_displacement = result.solution.displacement.rowwise().norm().maxCoeff();
  result.measures.seconds_stepping = seconds_since(start);
  return result;
}

SolveResult solve(const Model& model, const SolveOptions& given, const Progress& progress) {
  if (given.region > 0) {
    return solve_region(model, given, progress);
  }
  const auto start = Clock::now();
  const SolveOptions options = completed(given, model);
  SolveMeasures measures;
  std::optional<Resected> resected;
  if (model.resection) {
    resected = resect(model, options);
    measures.resection = resected->measures;
  }
  const Model& solved = resected ? resected->rest : model;
  Prepared prepared = prepare(solved, options, {}, measures, progress);
  measures.seconds_setup = seconds_since(start);
  if (starts_coarse(model, options)) {
    const auto coarse = Clock::now();
    report(progress, 0, "solving a coarse cloud");
    prepared.start = coarse_start(model, options, prepared.original);
    measures.seconds_coarse = seconds_since(coarse);
  }
  return step(solved, options, std::move(prepared), measures, progress);
}

}  // namespace brainshift::solve
