// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "pipelines/scene/scene.hpp"
#include "pipelines/scene/solve_cost.hpp"

namespace brainshift::pipelines {

/// What a run's memory depends on: estimates.
struct RunSize {
  SolveSize solve;
  double voxels = 0;        ///< of the grid that the run works on: the T1's, else the labels'
  double label_voxels = 0;  ///< of the label map or mask as it is read
};

/// The most memory that a stage of ours holds at once, as run.json's peak_memory_mb counts it (MiB, the program and its
/// libraries with it), on any number of threads: no less than it takes, and no more than half above. Empty where nobody
/// can know: adaptive integration adds points as it goes. Not counted are further files that are to be warped, and
/// cuts.
std::optional<double> stage_memory(StageId stage, const Scene& scene, const RunSize& size);

}  // namespace brainshift::pipelines
