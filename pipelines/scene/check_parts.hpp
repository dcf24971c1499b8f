// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// The parts that a scene need not have: cuts, septa, a resection, <uncertainty>. Their files are read, and
/// none may be there beside what it does not go with. Throws std::invalid_argument naming file and line, what was found
/// and what to do.
void check_parts(const Scene& scene);

/// Whether the scene or the load's file says how well its points were measured. Throws as read_craniotomy_csv().
bool has_noise(const Load& load);

/// The part of it for a region of the body.
void check_region(const Scene& scene);

/// The part of it for the resection: its labels are some of the tissues', not all.
void check_resection(const Scene& scene);

}  // namespace brainshift::pipelines
