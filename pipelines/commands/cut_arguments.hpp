// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/runner/jobs.hpp"

namespace brainshift::pipelines {

/// What the command line says of cuts, rupture and resection.
struct CutArguments {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> paths;
  CutFile timed;  ///< its timing is that of all cuts
  std::optional<std::string> rupture;
  std::vector<std::string> weak_spots;
};

/// Adds their options; contact of cuts and resection are the scene's.
void add_cut_options(CLI::App& command, Scene& scene, CutArguments& arguments);

/// Puts what they say into the job, whose plane is known, and the cuts' files into the scene. Throws
/// std::invalid_argument, naming the option, when it makes no sense.
void read_cut_arguments(const CutArguments& arguments, Scene& scene, SolveJob& job);

}  // namespace brainshift::pipelines
