// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cctype>
#include <map>
#include <memory>

#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/cut_arguments.hpp"
#include "pipelines/scene/check_parts.hpp"
#include "pipelines/scene/check_scene.hpp"
#include "pipelines/scene/check_tissues.hpp"
#include "pipelines/scene/tissue_table.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/options/values.hpp"
#include "solve/material/named_materials.hpp"

namespace brainshift::pipelines {
namespace {

struct SolveArguments {
  Scene scene;
  SolveJob job;
  std::vector<std::string> materials;
  std::filesystem::path craniotomy;
  std::vector<std::filesystem::path> markups;
  std::vector<std::filesystem::path> surfaces;
  std::string plane;
  CutArguments cuts;
  std::filesystem::path out;
};

void set_material(Tissue& tissue, const std::string& name, const std::string& value, const std::string& text) {
  const Option<Tissue>* option = find_option(tissue_options(), name);
  if (!set_option(*option, tissue, value)) {
    throw std::invalid_argument("--material '" + text + "': " + refusal(*option, value));
  }
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// What a --material says: numbers or a name in their places, then attributes, of which a list keeps its commas.
struct MaterialWords {
  std::vector<std::string> placed;
  std::map<std::string, std::string> attributes;
};

MaterialWords words_of(const std::string& values, const std::string& text) {
  MaterialWords words;
  std::string* last = nullptr;
  for (const std::string& part : split(values, ',')) {
    const std::size_t equals = part.find('=');
    if (equals != std::string::npos) {
      const auto [at, is_new] = words.attributes.emplace(part.substr(0, equals), part.substr(equals + 1));
      const Option<Tissue>* option = find_option(tissue_options(), at->first);
      if (option == nullptr || names_tissue(option->name)) {
        throw std::invalid_argument("--material '" + text + "' has no attribute '" + at->first +
                                    "'; allowed: " + option_names(tissue_options()) + ", without label");
      }
      if (!is_new) {
        throw std::invalid_argument("--material '" + text + "' names " + at->first + " twice");
      }
      last = &at->second;
    } else if (last != nullptr) {
      *last += "," + part;
    } else {
      words.placed.push_back(part);
    }
  }
  return words;
}

/// The attributes of a <tissue>, in whose order they are set: 'LABEL:E_Pa,nu[,density]' or 'LABEL:NAME', then
/// 'ATTRIBUTE=VALUE' as in a scene, or these alone.
Tissue read_material(const std::string& text) {
  const std::size_t colon = text.find(':');
  MaterialWords words = words_of(colon == std::string::npos ? "" : text.substr(colon + 1), text);
  const std::size_t placed = words.placed.size();
  const bool named = placed == 1 && !words.placed[0].empty() && std::isalpha(words.placed[0][0]) != 0;
  if (colon == std::string::npos ||
      !(named || placed == 2 || placed == 3 || (placed == 0 && colon + 1 < text.size()))) {
    throw std::invalid_argument("--material '" + text +
                                "' is not LABEL:E_Pa,nu or LABEL:E_Pa,nu,density, as 1:3000,0.49 is, nor LABEL:NAME or "
                                "LABEL:ATTRIBUTE=VALUE,..., as 1:brain is and 1:law=ogden,ogden=842,-4.7");
  }
  const std::array<std::string, 3> places = {"youngs_modulus", "poisson_ratio", "density"};
  for (std::size_t i = 0; i < placed; ++i) {
    const std::string& name = named ? "material" : places[i];
    if (!words.attributes.emplace(name, words.placed[i]).second) {
      throw std::invalid_argument("--material '" + text + "' gives " + name + " twice");
    }
  }
  words.attributes["label"] = text.substr(0, colon);
  Tissue tissue;
  for (const auto& option : tissue_options()) {
    if (const auto found = words.attributes.find(option.name); found != words.attributes.end()) {
      set_material(tissue, found->first, found->second, text);
    }
  }
  try {
    check_material(tissue);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("--material '" + text + "': " + error.what());
  }
  return tissue;
}

solve::Plane plane_of(const std::string& name) {
  if (!name.empty() && name != "strain" && name != "stress") {
    throw std::invalid_argument("--plane is '" + name + "', but must be strain | stress");
  }
  return name.empty() ? solve::Plane::none : name == "strain" ? solve::Plane::strain : solve::Plane::stress;
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
  if (count == 0 && arguments.scene.load) {
    throw std::invalid_argument("--margin, --depth and --farthest are of a load; give --load, --markups or --surfaces");
  }
  return count == 1 ? std::optional(load) : std::nullopt;
}

void solve(const SolveArguments& arguments, const Settings& settings) {
  Scene scene = arguments.scene;
  SolveJob job = arguments.job;
  job.plane = plane_of(arguments.plane);
  read_cut_arguments(arguments.cuts, scene, job);
  check_solve_options(scene);
  job.options = scene.solve;
  job.loading = scene.loading;
  job.load = load_of(arguments);
  job.gravity = scene.gravity;
  job.cuts = scene.cuts;
  job.resection = scene.resection;
  for (const std::string& text : arguments.materials) {
    scene.tissues.push_back(read_material(text));
    const Tissue& tissue = scene.tissues.back();
    if (!job.materials.emplace(tissue.label, tissue.material).second) {
      throw std::invalid_argument("--material names label " + std::to_string(tissue.label) + " twice");
    }
  }
  check_resection(scene);
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
      ->add_option("--material", arguments->materials,
                   "of one label; again for each. 1:3000,0.49 or with a density, 1000 kg/m3 if absent; a name from the "
                   "literature, 1:brain_ogden (" +
                       with_commas(solve::material_names()) +
                       "); or attributes of a scene's <tissue>, also behind these: "
                       "'1:law=ogden,ogden=842,-4.7,poisson_ratio=0.49,prony=0.45,0.5;0.365,50', in quotes for the "
                       "semicolon's sake")
      ->required()
      ->type_name("LABEL:E_Pa,nu[,density] | LABEL:NAME | LABEL:ATTRIBUTE=VALUE,...")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--labels", arguments->job.labels, "label map; without it the cells' labels count")
      ->type_name("FILE");
  command
      ->add_option("--surface", arguments->job.surface,
                   "the body's closed surface, that of discretise: free faces then carry no force, whatever the cells")
      ->type_name("FILE");
  command->add_option("--skull", arguments->job.skull, "the skull's inner surface, for contact")->type_name("FILE");
  command
      ->add_option("--septum", arguments->job.septum,
                   "a rigid sheet inside the body, along which tissue slides: " + std::string(listed_surface_endings))
      ->type_name("FILE");
  command
      ->add_option("--plane", arguments->plane,
                   "a plane problem, of cells that are quadrilaterals or triangles, z = 0 and 1 mm thick")
      ->type_name("strain | stress");
  command
      ->add_option("--load", arguments->craniotomy,
                   "craniotomy.csv; without a load the nodes' own; their forces act in any case")
      ->type_name("FILE");
  command->add_option("--markups", arguments->markups, "markups before and after")->expected(2)->type_name("FILE");
  command->add_option("--surfaces", arguments->surfaces, "cortex before and after")->expected(2)->type_name("FILE");
  add_stage_options(*command, arguments->scene, "solve");
  add_scene_option(*command, arguments->scene, "gravity", "direction", "--gravity-direction");
  for (const char* name : {"fluid_level", "drained", "fluid_point", "fluid_density", "image_direction"}) {
    add_scene_option(*command, arguments->scene, "gravity", name);
  }
  for (const char* name : {"margin", "depth", "farthest"}) {
    add_scene_option(*command, arguments->scene, "load", name);
  }
  add_cut_options(*command, arguments->scene, arguments->cuts);
  command->add_option("--out", arguments->out, "folder for the artefacts")->required()->type_name("DIR");
  command->callback([arguments, &settings] { solve(*arguments, settings); });
}

}  // namespace brainshift::pipelines
