// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// What parsing alone cannot see, before anything is computed: files that the scene names and that are not there, parts
/// that exclude or need each other, tissues and labels that do not match (the label map is read). Throws
/// std::invalid_argument naming file and line, what was found and what to do.
void check_scene(const Scene& scene);

/// The part of it for the options of the solve stage: those that exclude or need each other, and the load's curve.
void check_solve_options(const Scene& scene);

}  // namespace brainshift::pipelines
