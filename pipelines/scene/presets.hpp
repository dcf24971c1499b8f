// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace brainshift::pipelines {

/// The "path=value" overrides of a preset: settings of the measured front of speed and accuracy
/// (tradeoff/README.md), then those given, which so override them. No name: those given. Throws std::invalid_argument,
/// listing the names, on another name.
std::vector<std::string> preset_overrides(const std::string& name, const std::vector<std::string>& given = {});

/// "fast | balanced | accurate".
std::string preset_names();

/// What each is for, in a sentence.
std::string preset_help();

}  // namespace brainshift::pipelines
