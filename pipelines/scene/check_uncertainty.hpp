// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// Throws std::invalid_argument with a sentence where a scene with <uncertainty> has nothing that is uncertain, or a
/// part that it does not go with. Reads a craniotomy.csv for its sigma.
void check_uncertainty(const Scene& scene);

}  // namespace brainshift::pipelines
