// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/step.hpp"

#include <sstream>

#include "segmentation/progress/stopwatch.hpp"
#include "solve/body/ordered_cloud.hpp"
#include "solve/cut/dissection.hpp"
#include "solve/device/relax_if_asked.hpp"
#include "solve/dynamics/diagnosis.hpp"
#include "solve/dynamics/relaxation.hpp"
#include "solve/dynamics/transient.hpp"
#include "solve/output/cut_surface.hpp"
#include "solve/output/field_difference.hpp"
#include "solve/output/stress_strain.hpp"
#include "solve/shape/nodal_displacement.hpp"

namespace brainshift::solve {

namespace {

/// What stepping does not see; empty: nothing.
std::string lost_contact(const Contact::Measures& touch) {
  if (!touch.lost) {
    return {};
  }
  std::ostringstream text;
  text << "the surface passed through the skull, by " << touch.largest_penetration
       << " mm or more: the load comes too fast; spread it over more steps";
  return text.str();
}

/// What the end state says of itself; completes the failure that stepping left.
void measure(const SteppingResult& stepped, SolveMeasures& m, std::string& failure) {
  const Body& body = stepped.body;
  m.steps = stepped.steps;
  m.error_bound = stepped.error_bound;
  m.critical_step = stepped.critical_step;
  m.constraint_error = body.essential.largest_error(stepped.fraction, stepped.parameters);
  if (body.contact) {
    const Contact::Measures touch = body.contact->measure(stepped.parameters);
    m.contact_nodes = touch.touching;
    m.largest_penetration = touch.largest_penetration;
    failure = failure.empty() ? lost_contact(touch) : failure;
  }
  m.converged = failure.empty();
  m.smallest_jacobian = stepped.state.smallest_jacobian;
  m.largest_stretch = stepped.state.largest_stretch;
  m.compressed_share = stepped.state.compressed_share;
}

CutMeasures measure_cut(const CutBody& cut, const SteppingResult& stepped, std::size_t nodes, CutMeasures measures) {
  measures.split_nodes = cut.split;
  measures.added_nodes = cut.cloud.size() - nodes;
  measures.extent = extent(cut.facets()) - extent(cut.septum);
  if (stepped.body.face_contact) {
    measures.faces = stepped.body.face_contact->measure(stepped.parameters);
  }
  return measures;
}

SeptumMeasures measure_septum(const CutBody& cut, const SteppingResult& stepped) {
  const SeptumContact::Measures touch = stepped.body.septum_contact->measure(stepped.parameters);
  return {.area = extent(cut.septum),
          .face_nodes = 2 * cut.septum_pairs,
          .touching_nodes = touch.touching,
          .largest_penetration = touch.largest_penetration};
}

double deformed_volume(const Surface& wall, const Solution& solution) {
  Surface moved = wall;
  moved.vertices += displacement_at(solution, wall.vertices);
  return volume(moved);
}

void measure_wall(const Surface& wall, const SteppingResult& stepped, const Solution& solution,
                  ResectionMeasures& measures) {
  measures.touch = stepped.body.wall_contact->measure(stepped.parameters);
  if (measures.volume) {  // the wall closes around the cavity
    measures.volume = deformed_volume(wall, solution);
  }
}

/// The displacement field of the last good state.
Solution solution_of(const SteppingResult& stepped, const SolveOptions& options) {
  constexpr double newton = 1e-6;  // µN to N
  const Body& body = stepped.body;
  return {.positions = body.positions,
          .displacement = nodal_displacement(body.nodal_rows, stepped.parameters, body.original),
          .reaction_force = newton * in_original_order(stepped.reactions, body.original),
          .spacing = body.spacing,
          .shape = options.shape,
          .cut = body.cut};
}

}  // namespace

SolveResult result_of(SteppingResult& stepped, const SolveOptions& options, SolveMeasures measures) {
  SolveResult result;
  result.measures = std::move(measures);
  result.failure = stepped.failure;
  result.unstable = stepped.unstable;
  result.rounded = stepped.rounded;
  measure(stepped, result.measures, result.failure);
  result.measures.pressed_share = options.volumetric == Volumetric::mean_dilatation ? stepped.state.pressed_share : 0;
  if (stepped.fault) {
    result.failure += ' ';
    result.failure += describe(*stepped.fault, stepped.body);
  }
  result.history = std::move(stepped.history);
  result.snapshots = std::move(stepped.snapshots);
  result.solution = solution_of(stepped, options);
  result.measures.largest_displacement = result.solution.displacement.rowwise().norm().maxCoeff();
  return result;
}

namespace {

/// What the solution was at a snapshot. Nodes that were added since are the last ones.
Solution state_at(const Snapshot& snapshot, const Solution& end) {
  Solution state = end;
  state.displacement = snapshot.displacement;
  state.positions = snapshot.positions;
  state.cut = snapshot.cut;
  state.spacing.resize(static_cast<std::size_t>(snapshot.positions.rows()));
  return state;
}

}  // namespace

void draw_faces(const InsideBody& inside, SolveResult& result) {
  for (Snapshot& snapshot : result.snapshots) {
    if (!snapshot.cut.empty()) {
      snapshot.faces = cut_surface(state_at(snapshot, result.solution), inside);
    }
  }
  if (!result.solution.cut.empty()) {
    result.faces = cut_surface(result.solution, inside);
  }
}

SolveResult step_to_end(const Model& model, const SolveOptions& options, Prepared prepared, SolveMeasures measures,
                        NodalVectors start, const Progress& progress) {
  const Stopwatch begin;
  std::optional<Dissection> dissection;
  if (prepared.cut && prepared.parts) {
    dissection.emplace(model, options, std::move(*prepared.cut), std::move(*prepared.parts));
  }
  const Course course{
      .curve = model.curve, .start = std::move(start), .change = dissection ? dissection->change() : BodyChange()};
  const bool moves = options.dynamics == Dynamics::transient;
  if (moves) {
    device::leave_motion_to_processor(options, progress);
  }
  SteppingResult stepped = moves ? march(std::move(prepared.body), course, options, progress)
                                 : relax(std::move(prepared.body), course, options, progress, device::relax_if_asked);
  SolveResult result = result_of(stepped, options, std::move(measures));
  if (prepared.cut) {
    const CutBody& cut = dissection ? dissection->body() : *prepared.cut;
    if (!model.cuts.empty() || model.rupture) {
      result.measures.cut =
          measure_cut(cut, stepped, model.cloud.size(), dissection ? dissection->measures() : CutMeasures());
    }
    if (model.septum) {
      result.measures.septum = measure_septum(cut, stepped);
    }
  }
  if (stepped.body.wall_contact) {
    measure_wall(*model.resection->wall, stepped, result.solution, *result.measures.resection);
  }
  if (model.rupture) {
    result.stress_strain = stress_strain(model, options.dynamics, result.history);
  }
  result.measures.seconds_stepping = begin.seconds();
  return result;
}

}  // namespace brainshift::solve
