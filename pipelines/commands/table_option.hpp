// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "segmentation/options/option.hpp"

namespace brainshift::pipelines {

/// Adds an option of a scene's table to a command, with its help and default; its text goes into the target when the
/// command line is parsed. `option` and target must outlive the command.
template <class T>
CLI::Option* add_table_option(CLI::App& command, const std::string& flag, const Option<T>& option,
                              const std::function<T&()>& target, const T& defaults = {}) {
  const auto set = [&option, target, flag](const std::string& value) {
    if (!set_option(option, target(), value)) {
      throw CLI::ValidationError(flag, refusal(option, value));
    }
  };
  return command.add_option_function<std::string>(flag, set, option.help)
      ->type_name(option.is_path ? "FILE" : option.allowed + (option.unit.empty() ? "" : ", " + option.unit))
      ->default_str(option.get(defaults));
}

}  // namespace brainshift::pipelines
