// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/runner/interruption.hpp"

namespace brainshift::pipelines {

struct ExternalCommand {
  std::string command;              ///< as the scene has it, with {in} and {out}
  std::filesystem::path in;         ///< the run's folder
  std::filesystem::path out;        ///< where the stage's artefacts go
  std::filesystem::path directory;  ///< where it runs: the scene's folder
};

/// Runs the command with /bin/sh; what it prints goes to out/command.log. Throws std::invalid_argument, with the exit
/// code and the last lines that it printed, when it does not exit with 0, and std::runtime_error when the system cannot
/// start it.
void run_external_command(const ExternalCommand& command, Interruption& interruption);

/// The command with {in} and {out} filled in, quoted for the shell.
std::string fill_in(const ExternalCommand& command);

}  // namespace brainshift::pipelines
