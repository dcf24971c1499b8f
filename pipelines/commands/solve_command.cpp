// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "pipelines/commands/commands.hpp"
#include "pipelines/scene/scene_table.hpp"

namespace brainshift::pipelines {
namespace {

struct SolveArguments {
  Scene scene;
  SolveJob job;
  std::vector<std::string> materials;
  std::filesystem::path craniotomy;
  std::vector<std::filesystem::path> markups;
  std::vector<std::filesystem::path> surfaces;
  std::filesystem::path out;
};

void set_material(Tissue& tissue, const std::string& name, const std::string& value, const std::string& text) {
  const Option<Tissue>* option = find_option(tissue_options(), name);
  if (!option->set(tissue, value)) {
    throw std::invalid_argument("--material '" + text + "': " + name + " is '" + value + "', but must be " +
                                option->allowed + (option->unit.empty() ? "" : " (" + option->unit + ")"));
  }
}

/// 'LABEL:E_Pa,nu,density' or without density.
Tissue read_material(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = text.find(':'); end != std::string::npos; end = text.find(',', begin)) {
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  parts.push_back(text.substr(begin));
  if (parts.size() < 3 || parts.size() > 4) {
    throw std::invalid_argument("--material '" + text +
                                "' is not LABEL:E_Pa,nu or LABEL:E_Pa,nu,density, as 1:3000,0.49 is");
  }
  const std::array<std::string, 4> names = {"label", "youngs_modulus", "poisson_ratio", "density"};
  Tissue tissue;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    set_material(tissue, names[i], parts[i], text);
  }
  return tissue;
}

std::optional<Load> load_of(const SolveArguments& arguments) {
  Load load = arguments.scene.load.value_or(Load{});
  if (!arguments.craniotomy.empty()) {
    load.craniotomy = arguments.craniotomy;
  }
  if (!arguments.markups.empty()) {
    load.markups = {arguments.markups[0], arguments.markups[1]};
  }
  if (!arguments.surfaces.empty()) {
    load.surfaces = {arguments.surfaces[0], arguments.surfaces[1]};
  }
  const int count = int{load.craniotomy.has_value()} + int{load.markups.has_value()} + int{load.surfaces.has_value()};
  if (count > 1) {
    throw std::invalid_argument("give one of --load, --markups and --surfaces");
  }
  return count == 1 ? std::optional(load) : std::nullopt;
}

void solve(const SolveArguments& arguments, const Settings& settings) {
  SolveJob job = arguments.job;
  job.options = arguments.scene.solve;
  job.points_per_cell = arguments.scene.points_per_cell;
  job.load = load_of(arguments);
  for (const std::string& text : arguments.materials) {
    const Tissue tissue = read_material(text);
    if (!job.materials.emplace(tissue.label, tissue.material).second) {
      throw std::invalid_argument("--material names label " + std::to_string(tissue.label) + " twice");
    }
  }
  run_single_stage(StageId::solve, arguments.out, settings,
                   [&](const auto& folder, const Progress& progress) { return run_job(job, folder, progress); });
}

}  // namespace

void add_solve_command(CLI::App& program, const Settings& settings) {
  CLI::App* command = program.add_subcommand("solve", "Nodes, cells and a load to displacements (MTLED).");
  auto arguments = std::make_shared<SolveArguments>();
  command->add_option("--nodes", arguments->job.nodes, "nodes.vtu")->required()->type_name("FILE");
  command->add_option("--cells", arguments->job.cells, "cells.vtu")->required()->type_name("FILE");
  command
      ->add_option("--material", arguments->materials, "of one label; again for each; density is 1000 kg/m3 if absent")
      ->required()
      ->type_name("LABEL:E_Pa,nu,density")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--labels", arguments->job.labels, "label map; without it the cells' labels count")
      ->type_name("FILE");
  command->add_option("--skull", arguments->job.skull, "the skull's inner surface, for contact")->type_name("FILE");
  command->add_option("--load", arguments->craniotomy, "craniotomy.csv; without a load the nodes' own")
      ->type_name("FILE");
  command->add_option("--markups", arguments->markups, "markups before and after")->expected(2)->type_name("FILE");
  command->add_option("--surfaces", arguments->surfaces, "cortex before and after")->expected(2)->type_name("FILE");
  for (const char* name : {"basis", "derivatives", "dilatation", "penalty", "volumetric", "points_per_cell",
                           "tolerance", "load_steps", "max_steps", "snapshot_every"}) {
    add_scene_option(*command, arguments->scene, "solve", name);
  }
  for (const char* name : {"margin", "depth", "farthest"}) {
    add_scene_option(*command, arguments->scene, "load", name);
  }
  command->add_option("--out", arguments->out, "folder for the artefacts")->required()->type_name("DIR");
  command->callback([arguments, &settings] { solve(*arguments, settings); });
}

}  // namespace brainshift::pipelines
