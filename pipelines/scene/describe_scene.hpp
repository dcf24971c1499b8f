// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// A commented scene with every option at its default. Parts that are not built unless named stand in comments. It
/// parses, and gives the defaults.
std::string default_scene();

/// What the scene asks for, option by option as text: {"image": {"t1": "...", ...}, "tissues": {"1": {...}}, ...},
/// tissues by their labels and cuts counted from 1; only parts that are present.
nlohmann::ordered_json effective_options(const Scene& scene);

}  // namespace brainshift::pipelines
