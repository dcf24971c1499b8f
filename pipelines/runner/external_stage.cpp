// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/external_stage.hpp"

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipelines/runner/external_command.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/image/image.hpp"
#include "solve/output/solution_file.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

/// What other programs write must be readable before the stage counts as done.
void check_artefacts(StageId stage, const std::vector<std::string>& artefacts, const fs::path& out) {
  switch (stage) {
    case StageId::segment:
      read_surface(out / "brain.vtp");
      break;
    case StageId::discretise:
      read_node_cloud(out / "nodes.vtu");
      read_background_cells(out / "cells.vtu");
      break;
    case StageId::solve:
      read_solution(out / "solution.vtu");
      break;
    case StageId::registration:
      read_image(out / artefacts.front());
      break;
    case StageId::report:
      break;
  }
}

void run_command_stage(const ExternalCommand& command, StageId stage, const std::vector<std::string>& artefacts,
                       Interruption& interruption) {
  run_external_command(command, interruption);
  for (const std::string& name : artefacts) {
    if (!fs::exists(command.out / name)) {
      throw std::invalid_argument("the command '" + command.command + "' of stage " + std::string(stage_name(stage)) +
                                  " wrote no " + name + "; it must write it to the folder given as {out}");
    }
  }
  try {
    check_artefacts(stage, artefacts, command.out);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("the command '" + command.command + "' of stage " + std::string(stage_name(stage)) +
                                " wrote something else than it must: " + error.what());
  }
}

}  // namespace

void make_external(StagePlan& plan, const Scene& scene, const fs::path& folder, Interruption& interruption) {
  const std::string& command = scene.commands[index_of(plan.stage)];
  const fs::path directory = fs::absolute(scene.source.file).parent_path();
  plan.options["command"] = command;
  plan.inputs = scene_files(scene);
  for (const StageId stage : all_stages) {
    if (stage < plan.stage && fs::is_directory(folder / stage_name(stage))) {
      for (const auto& entry : fs::directory_iterator(folder / stage_name(stage))) {
        plan.inputs.push_back({std::string(stage_name(stage)) + "/" + entry.path().filename().string(), entry.path()});
      }
    }
  }
  std::erase_if(plan.inputs, [](const InputFile& file) { return file.path.filename() == "stage.json"; });
  std::istringstream words(command);
  for (std::string word; words >> word;) {
    std::error_code none;  // a word need not be a file's name
    if (fs::is_regular_file(directory / word, none)) {
      plan.inputs.push_back({"command/" + word, directory / word});
    }
  }
  const fs::path in = folder;
  plan.work = [command, in, directory, stage = plan.stage, artefacts = plan.artefacts, &interruption](
                  const fs::path& out, const Progress&) {
    run_command_stage({.command = command, .in = in, .out = out, .directory = directory}, stage, artefacts,
                      interruption);
    return StageReport{};
  };
}

}  // namespace brainshift::pipelines
