// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/runner/run.hpp"
#include "solve/output/field_difference.hpp"

namespace brainshift::pipelines {

/// One of the clouds that a run to a tolerance solves on.
struct Level {
  std::size_t nodes = 0;
  double spacing = 0;  ///< mean, mm
  double seconds = 0;  ///< of discretise and solve
  /// Estimated error of the displacement over the brain, mm; that of the first level is not known (infinite).
  solve::FieldDifference estimate;
};

/// Estimate of the error of the finer of two solutions: their difference / (ratio^p − 1), ratio that of their spacings
/// (> 1), with p = 1.5, the order that was measured (README.md), and the stop tolerance, which bounds what stepping
/// left.
solve::FieldDifference estimated_error(const solve::FieldDifference& difference, double ratio, double stop);

/// Nodes of the next level, so that the estimate becomes nine tenths of the tolerance: at least twice, at most eight
/// times as many.
std::size_t next_nodes(const Level& level, double tolerance);

struct Tolerance {
  double error = 0;                       ///< mm, of the displacement, 95 % of the brain
  std::optional<std::size_t> most_nodes;  ///< absent: what fits the memory
};

struct ToleranceOutcome {
  RunOutcome run;
  std::vector<Level> levels;
  std::string missed;  ///< empty, or a sentence: the tolerance was not reached, what was
};

/// Runs a checked scene to a tolerance: chooses spacing, basis, integration and stop itself, solves on finer and finer
/// clouds (runs in out/levels/NODES) until the estimated error is below it, and goes on with the last. Estimates are in
/// run.json and in the solve stage's measures. What is there already is not solved again. Ends, with `missed`, where a
/// finer cloud would have more than most_nodes or not fit the memory. Throws as run() does, and std::invalid_argument
/// when a stage that would have to be varied is an external command.
ToleranceOutcome run_to_tolerance(const Scene& scene, const Tolerance& tolerance, const RunOptions& options,
                                  Interruption& interruption, const RunObserver& observer = {},
                                  const std::function<void(const Level&)>& level_done = {});

}  // namespace brainshift::pipelines
