// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>

#include "pipelines/runner/interruption.hpp"
#include "pipelines/runner/jobs.hpp"

namespace brainshift::pipelines {

/// What every command may use.
struct Settings {
  bool quiet = false;
  bool verbose = false;
  Interruption* interruption = nullptr;
};

/// The computation did not converge or went unstable: exit code 3.
struct NotConverged : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Each adds its command to the program; the command runs when it is parsed.
void add_run_command(CLI::App& program, const Settings& settings);
void add_segment_command(CLI::App& program, const Settings& settings);
void add_discretise_command(CLI::App& program, const Settings& settings);
void add_solve_command(CLI::App& program, const Settings& settings);
void add_register_command(CLI::App& program, const Settings& settings);
void add_warp_command(CLI::App& program, const Settings& settings);
void add_update_command(CLI::App& program, const Settings& settings);
void add_live_command(CLI::App& program, const Settings& settings);
void add_report_command(CLI::App& program, const Settings& settings);
void add_phantom_command(CLI::App& program, const Settings& settings);
void add_scene_command(CLI::App& program, const Settings& settings);
void add_slicer_command(CLI::App& program, const Settings& settings);
void add_tradeoff_command(CLI::App& program, const Settings& settings);

/// Runs a stage's work in a folder of its own and moves what it wrote to `out` when it is whole, with stage.json beside
/// it. Throws NotConverged, after that, when the stage failed.
void run_single_stage(StageId stage, const std::filesystem::path& out, const Settings& settings,
                      const std::function<StageReport(const std::filesystem::path& folder, const Progress&)>& work);

/// Adds an option of the scene's table to a command, under the same name with dashes, help and default:
/// "--edge-length", or under another flag. Its text goes into `scene` when the command line is parsed; a text that is
/// not allowed is an error of the command line.
CLI::Option* add_scene_option(CLI::App& command, Scene& scene, const std::string& element, const std::string& name,
                              const std::string& other_flag = {});

/// All options of a stage but the command that may stand for it.
void add_stage_options(CLI::App& command, Scene& scene, const std::string& stage);

/// "--device": what answers another load of a run, as the solve stage's option; absent: the run's own.
CLI::Option* add_device_option(CLI::App& command, std::optional<solve::Device>& device);

}  // namespace brainshift::pipelines
