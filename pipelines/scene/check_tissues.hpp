// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// That each label of the brain has one material and each tissue a label that will be there; the label map is read.
/// Throws std::invalid_argument naming file and line, what was found and what to do.
void check_tissues(const Scene& scene);

/// Throws std::invalid_argument, one sentence, when the material is one that solve::check_material refuses.
void check_material(const Tissue& tissue);

}  // namespace brainshift::pipelines
