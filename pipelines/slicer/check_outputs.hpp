// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace brainshift::pipelines {

/// Looks at the places of the module's outputs before anything is computed. values: those given, by flag. return_file:
/// of the return parameters, empty without one. Throws std::invalid_argument, naming the option and what to do, unless
/// each output can be written there and takes the place of no input and of no other output.
void check_outputs(const std::map<std::string, std::string>& values, const std::filesystem::path& return_file);

}  // namespace brainshift::pipelines
