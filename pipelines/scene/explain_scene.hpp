// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// Which parts of a checked scene are active, which are not built, and what each stage costs: estimates from the size
/// of the brain (label map or mask, else 1.4 litres) and the options.
std::string explain_scene(const Scene& scene);

}  // namespace brainshift::pipelines
