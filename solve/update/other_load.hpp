// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/progress/progress.hpp"
#include "solve/update/kept.hpp"

namespace brainshift::solve {

/// Holds the kept body as a run under this load holds its own, and lets it touch the skull where that one may. Throws
/// TooFewNodes where conditions contradict each other: the run is then as it was.
void set_load(const Conditions& load, KeptRun& run);

/// Whether the body's derivatives are those of a run under this load: the same nodes of the surface are held in all
/// directions (boundary_normals.hpp).
bool is_prepared_for(const Points& prescribed, const KeptRun& run);

/// Takes the body of the run's own nodes, or lays it out as a run under this load does, from KeptRun::made_from: then
/// prepared_for has no rows, as masses and damping are not known. Throws std::invalid_argument where made_from is not
/// set or of another cloud, and as prepare(): the run is then as it was.
void prepare_for(const Conditions& load, KeptRun& run, const Progress& progress);

/// Thins the body as a run under this load does: loaded nodes stay rather than others. Leaves it alone where that was
/// done for the same nodes, or made_from is not set. Throws std::invalid_argument where that is of another cloud.
void thin_for(const Conditions& load, KeptRun& run);

}  // namespace brainshift::solve
