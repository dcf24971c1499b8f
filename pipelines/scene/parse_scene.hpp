// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// Reads a scene and puts "path=value" overrides on top (--set; a file name in one is relative to the scene's file,
/// like those in it). Throws std::invalid_argument, naming file, line, what was found and what is allowed, on text that
/// is no XML, an unknown or repeated element, attribute or path, a missing attribute, a value out of range. Looks at no
/// file that the scene names: that is check_scene's.
Scene parse_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

}  // namespace brainshift::pipelines
