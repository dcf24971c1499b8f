// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/whole_body.hpp"

#include <algorithm>

#include "segmentation/progress/stopwatch.hpp"
#include "solve/cut/resection.hpp"
#include "solve/run/coarse.hpp"
#include "solve/run/prepare.hpp"
#include "solve/run/step.hpp"

namespace brainshift::solve {

namespace {

bool starts_coarse(const Model& model, const SolveOptions& options) {
  return options.start == Start::coarse && options.dynamics == Dynamics::relaxation && options.snapshot_every == 0 &&
         model.plane == Plane::none && model.cuts.empty() && !model.rupture && !model.resection &&
         model.curve.at(model.curve.duration()) == 1;
}

/// The coarse solution's displacement at the nodes, taken for their parameters: near enough for a start.
NodalVectors coarse_start(const Model& model, SolveOptions options, const std::vector<std::int32_t>& original) {
  constexpr double factor = 5;  // what a coarse solution is wrong by is more
  options.tolerance *= factor;
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

}  // namespace

SolveResult solve_whole_body(const Model& model, const SolveOptions& given, const Progress& progress) {
  const Stopwatch start;
  const SolveOptions options = completed(given, model);
  SolveMeasures measures;
  std::optional<Resected> resected;
  if (model.resection) {
    resected = resect(model, options);
    measures.resection = resected->measures;
  }
  const Model& solved = resected ? resected->rest : model;
  Prepared prepared = prepare(solved, options, {}, measures, progress);
  measures.seconds_setup = start.seconds();
  NodalVectors coarse;
  if (starts_coarse(model, options)) {
    const Stopwatch begin;
    report(progress, 0, "solving a coarse cloud");
    coarse = coarse_start(model, options, prepared.body.original);
    measures.seconds_coarse = begin.seconds();
  }
  return step_to_end(solved, options, std::move(prepared), measures, std::move(coarse), progress);
}

}  // namespace brainshift::solve
