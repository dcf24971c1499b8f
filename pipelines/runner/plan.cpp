// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/plan.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "pipelines/report/report.hpp"
#include "pipelines/runner/external_command.hpp"
#include "pipelines/runner/json_text.hpp"
#include "pipelines/runner/sha256.hpp"
#include "pipelines/scene/describe_scene.hpp"
#include "pipelines/scene/field_load.hpp"
#include "pipelines/scene/scene_table.hpp"
#include "segmentation/files/surface_file.hpp"
#include "solve/material/material.hpp"
#include "solve/output/solution_file.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

/// A file that may be there.
fs::path if_there(const fs::path& file) {
  return fs::exists(file) ? file : fs::path();
}

/// Options that the stage's result depends on, as text; files count by their contents, not their names.
nlohmann::ordered_json options_of(const Scene& scene, const std::vector<std::string>& elements) {
  const nlohmann::ordered_json all = effective_options(scene);
  nlohmann::ordered_json options = nlohmann::ordered_json::object();
  for (const std::string& name : elements) {
    if (!all.contains(name)) {
      continue;
    }
    options[name] = all[name];
    if (const Element* element = find_element(name)) {
      for (const auto& option : element->options) {
        if (names_file(option, option.get(scene))) {
          options[name].erase(option.name);
        }
      }
    }
    if (name == "cuts") {
      for (std::size_t i = 0; i < scene.cuts->files.size(); ++i) {
        options[name][std::to_string(i + 1)].erase("file");
      }
    }
  }
  return options;
}

std::vector<InputFile> files_of(const Scene& scene, const std::vector<std::string>& elements) {
  std::vector<InputFile> files;
  for (const InputFile& file : scene_files(scene)) {
    const std::string element = file.role.substr(0, file.role.rfind('.'));
    const auto holds = [&](const std::string& name) { return element == name || element.starts_with(name + "."); };
    if (std::any_of(elements.begin(), elements.end(), holds)) {
      files.push_back(file);
    }
  }
  return files;
}

/// Artefacts of earlier stages, those of them that are there.
void add_artefacts(StagePlan& plan, const fs::path& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (fs::exists(folder / name)) {
      plan.inputs.push_back({name, folder / name});
    }
  }
}

std::vector<std::string> load_elements(const Scene& scene) {
  std::vector<std::string> names;
  for (const Element& element : scene_elements()) {
    if ((element.path == "load" || element.path.starts_with("load.")) && element.present(scene)) {
      names.push_back(element.path);
    }
  }
  return names;
}

std::vector<std::uint16_t> tissue_labels(const Scene& scene) {
  std::vector<std::uint16_t> labels;
  for (const Tissue& tissue : scene.tissues) {
    labels.push_back(tissue.label);
  }
  std::sort(labels.begin(), labels.end());
  return labels;
}

/// Strain jumps where stiffness does. Where that changes less than threefold, nodes are as well used elsewhere.
std::set<std::pair<std::int32_t, std::int32_t>> alike_labels(const std::vector<Tissue>& tissues) {
  std::set<std::pair<std::int32_t, std::int32_t>> alike;
  for (const Tissue& a : tissues) {
    for (const Tissue& b : tissues) {
      const double of_a = solve::shear_modulus(a.material), of_b = solve::shear_modulus(b.material);
      if (a.label < b.label && !solve::much_stiffer(of_a, of_b) && !solve::much_stiffer(of_b, of_a)) {
        alike.emplace(a.label, b.label);
      }
    }
  }
  return alike;
}

std::vector<std::uint16_t> resected_labels(const Scene& scene) {
  return {scene.resection->labels.begin(), scene.resection->labels.end()};
}

/// The wall of what is resected, where the cells are parted by it: another discretiser knows no wall.
fs::path wall_of(const Scene& scene, const fs::path& folder) {
  return scene.resection && is_ours(scene, StageId::discretise) ? if_there(folder / "segment" / "resection.vtp")
                                                                : fs::path();
}

/// The solution that a state of a sequence goes on from.
fs::path last_of(const Scene& scene, const fs::path& folder) {
  return scene.state && !scene.state->before.empty()
             ? if_there(folder.parent_path() / scene.state->before / "solve" / "solution.vtu")
             : fs::path();
}

StagePlan plan_segment(const Scene& scene) {
  SegmentJob job{scene.image, scene.segment, label_reading(scene)};
  job.options.brain_labels = tissue_labels(scene);
  job.options.skull_label = scene.image.skull_label;
  StagePlan plan{.stage = StageId::segment,
                 .inputs = files_of(scene, {"image"}),
                 .options = options_of(scene, {"image", "segment"}),
                 .artefacts = {"brain.vtp"},
                 .work = {}};
  if (scene.septa) {
    job.septa = true;
    plan.options["septa"] = true;
    plan.artefacts.emplace_back("septa.vtp");
  }
  if (scene.resection) {
    job.resected = resected_labels(scene);
    plan.options["resected"] = job.resected;
    const bool labels = !scene.image.labels.empty() || !scene.image.brain_mask.empty();
    if (labels && is_ours(scene, StageId::segment)) {
      plan.artefacts.emplace_back("resection.vtp");
    }
  }
  plan.options["brain_labels"] = job.options.brain_labels;
  plan.options["by_class"] = job.reading.by_class;
  plan.options["joined"] = job.reading.joined;
  plan.work = [job](const fs::path& out, const Progress& progress) { return run_job(job, out, progress); };
  return plan;
}

/// With the load at which nodes are finer.
Scene with_opening(Scene scene) {
  if (scene.state) {
    scene.load = scene.state->opening;
  }
  return scene;
}

StagePlan plan_discretise(const Scene& given, const fs::path& folder) {
  const Scene scene = with_opening(given);
  DiscretiseJob job{.surface = folder / "segment" / "brain.vtp",
                    .labels = if_there(folder / "segment" / "labels.nii.gz"),
                    .options = scene.discretise,
                    .load = {},
                    .refinement = scene.refinement};
  const auto labels = tissue_labels(scene);
  job.options.brain_labels.assign(labels.begin(), labels.end());
  job.options.alike = alike_labels(scene.state ? scene.state->tissues : scene.tissues);
  StagePlan plan{.stage = StageId::discretise,
                 .inputs = {},
                 .options = options_of(scene, {"discretise"}),
                 .artefacts = {"nodes.vtu", "cells.vtu"},
                 .work = {}};
  if (job.refinement.factor < 1) {
    job.load = scene.load;
    const auto load = load_elements(scene);
    plan.inputs = files_of(scene, load);
    plan.options["load"] = options_of(scene, load);
  }
  plan.options["brain_labels"] = labels;
  plan.options["alike"] = job.options.alike;
  add_artefacts(plan, folder, {"segment/brain.vtp", "segment/labels.nii.gz"});
  job.wall = wall_of(scene, folder);
  if (!job.wall.empty()) {
    job.resected = scene.resection->labels;
    plan.options["resected"] = job.resected;
    add_artefacts(plan, folder, {"segment/resection.vtp"});
  }
  plan.work = [job](const fs::path& out, const Progress& progress) { return run_job(job, out, progress); };
  return plan;
}

/// A load that says its noise on itself tells how well it knows the landmarks, and so do samples.
bool asks_for_landmarks(const Scene& scene) {
  return scene.landmarks && ((scene.load && scene.load->noise) || scene.uncertainty);
}

std::string name_of(const Tissue& tissue) {
  if (!tissue.name.empty() || tissue.tissue_class == 0) {
    return tissue.name.empty() ? "label " + std::to_string(tissue.label) : tissue.name;
  }
  return find_option(tissue_options(), "class")->get(tissue);
}

UncertaintyJob uncertainty_job(const Scene& scene, const fs::path& folder) {
  UncertaintyJob job{.options = *scene.uncertainty, .samples = folder / "samples", .tissues = {}};
  for (const Tissue& tissue : scene.tissues) {
    job.tissues[tissue.label] = name_of(tissue);
  }
  return job;
}

StagePlan plan_solve(const Scene& scene, const fs::path& folder) {
  const SolveJob job = solve_job(scene, folder);
  std::vector<std::string> elements = load_elements(scene);
  elements.insert(elements.end(), {"contact", "tissues", "gravity", "cuts", "septum", "resection", "solve"});
  if (asks_for_landmarks(scene)) {
    elements.emplace_back("landmarks");
  }
  if (scene.uncertainty) {
    elements.emplace_back("uncertainty");
  }
  StagePlan plan{.stage = StageId::solve,
                 .inputs = files_of(scene, elements),
                 .options = options_of(scene, elements),
                 .artefacts = {"solution.vtu"},
                 .work = {}};
  add_artefacts(plan, folder,
                {"discretise/nodes.vtu", "discretise/cells.vtu", "segment/brain.vtp", "segment/labels.nii.gz"});
  if (scene.load && scene.load->field) {
    plan.options["field_moves_points"] = direction_of(*scene.load->field) == registration::Moves::points;
  }
  if (scene.contact && scene.contact->skull.empty()) {
    add_artefacts(plan, folder, {"segment/skull.vtp"});
  }
  if (scene.septa) {
    add_artefacts(plan, folder, {"segment/septa.vtp"});
  }
  if (!job.wall.empty()) {
    add_artefacts(plan, folder, {"segment/resection.vtp"});
  }
  if (!job.last.empty()) {
    plan.inputs.push_back({"last/solution.vtu", job.last});
  }
  plan.work = [job](const fs::path& out, const Progress& progress) { return run_job(job, out, progress); };
  return plan;
}

StagePlan plan_register(const Scene& scene, const fs::path& folder) {
  const fs::path wall = wall_of(scene, folder);
  const RegisterJob job{.solution = folder / "solve" / "solution.vtu",
                        .surface = folder / "segment" / "brain.vtp",
                        .t1 = scene.image.t1,
                        .labels = if_there(folder / "segment" / "labels.nii.gz"),
                        .landmarks = scene.landmarks.value_or(fs::path()),
                        .uncertainty = if_there(folder / "solve" / "uncertainty.vtu"),
                        .wall = wall,
                        .resected = wall.empty() ? std::vector<std::int32_t>() : scene.resection->labels,
                        .warp = {},
                        .warp_labels = {},
                        .options = scene.registration};
  StagePlan plan{.stage = StageId::registration,
                 .inputs = {},
                 .options = options_of(scene, {"register"}),
                 .artefacts = {scene.image.t1.empty() ? "warped_labels.nii.gz" : "warped.nii.gz"},
                 .work = {}};
  for (const InputFile& file : scene_files(scene)) {
    if (file.role == "image.t1" || file.role == "landmarks.file") {
      plan.inputs.push_back(file);
    }
  }
  add_artefacts(plan, folder,
                {"solve/solution.vtu", "solve/uncertainty.vtu", "segment/brain.vtp", "segment/labels.nii.gz"});
  if (!wall.empty()) {
    plan.options["resected"] = job.resected;
    add_artefacts(plan, folder, {"segment/resection.vtp"});
  }
  plan.work = [job](const fs::path& out, const Progress& progress) { return run_job(job, out, progress); };
  return plan;
}

/// The report shows everything: the options, and all that the other stages left, their times too.
StagePlan plan_report(const Scene& scene, const fs::path& folder) {
  StagePlan plan{.stage = StageId::report,
                 .inputs = scene_files(scene),
                 .options = effective_options(scene),
                 .artefacts = {"index.html"},
                 .work = {}};
  for (const StageId stage : {StageId::segment, StageId::discretise, StageId::solve, StageId::registration}) {
    const fs::path stage_folder = folder / stage_name(stage);
    if (fs::is_directory(stage_folder)) {
      plan.inputs.push_back({std::string(stage_name(stage)), stage_folder});
    }
  }
  plan.work = [folder](const fs::path& out, const Progress& progress) {
    write_report(folder, out, progress);
    return StageReport{};
  };
  return plan;
}

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

void run_command_stage(const ExternalCommand& command, const StagePlan& plan, Interruption& interruption) {
  run_external_command(command, interruption);
  for (const std::string& name : plan.artefacts) {
    if (!fs::exists(command.out / name)) {
      throw std::invalid_argument("the command '" + command.command + "' of stage " +
                                  std::string(stage_name(plan.stage)) + " wrote no " + name +
                                  "; it must write it to the folder given as {out}");
    }
  }
  try {
    check_artefacts(plan.stage, plan.artefacts, command.out);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("the command '" + command.command + "' of stage " +
                                std::string(stage_name(plan.stage)) +
                                " wrote something else than it must: " + error.what());
  }
}

/// An external command may read all that is there before it; a script that it names counts by its contents.
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
    if (fs::is_regular_file(directory / word)) {
      plan.inputs.push_back({"command/" + word, directory / word});
    }
  }
  const fs::path in = folder;
  StagePlan expected = plan;
  plan.work = [command, in, directory, expected, &interruption](const fs::path& out, const Progress&) {
    run_command_stage({.command = command, .in = in, .out = out, .directory = directory}, expected, interruption);
    return StageReport{};
  };
}

}  // namespace

SolveJob solve_job(const Scene& scene, const fs::path& folder) {
  SolveJob job{.nodes = folder / "discretise" / "nodes.vtu",
               .cells = folder / "discretise" / "cells.vtu",
               .labels = if_there(folder / "segment" / "labels.nii.gz"),
               .skull = {},
               .surface = if_there(folder / "segment" / "brain.vtp"),
               .landmarks = asks_for_landmarks(scene) ? *scene.landmarks : fs::path(),
               .load = scene.load,
               .materials = {},
               .options = scene.solve,
               .loading = scene.loading,
               .gravity = scene.gravity,
               .cuts = scene.cuts,
               .resection = scene.resection,
               .wall = wall_of(scene, folder),
               .last = last_of(scene, folder)};
  if (scene.contact) {
    job.skull = scene.contact->skull.empty() ? folder / "segment" / "skull.vtp" : scene.contact->skull;
  }
  if (scene.septa || scene.septum) {
    job.septum = scene.septum ? scene.septum->file : folder / "segment" / "septa.vtp";
  }
  for (const Tissue& tissue : scene.tissues) {
    job.materials[tissue.label] = tissue.material;
  }
  if (scene.uncertainty) {
    job.uncertainty = uncertainty_job(scene, folder);
  }
  return job;
}

std::vector<InputFile> scene_files(const Scene& scene) {
  std::vector<InputFile> files;
  for (const Element& element : scene_elements()) {
    for (const auto& option : element.options) {
      if (element.present(scene) && names_file(option, option.get(scene))) {
        files.push_back({element.path + "." + option.name, option.get(scene)});
      }
    }
  }
  if (scene.cuts) {
    for (std::size_t i = 0; i < scene.cuts->files.size(); ++i) {
      files.push_back({"cuts." + std::to_string(i + 1) + ".file", scene.cuts->files[i].file});
    }
  }
  return files;
}

StagePlan plan_stage(StageId stage, const Scene& scene, const fs::path& folder, Interruption& interruption) {
  const auto plan_own = [&] {
    switch (stage) {
      case StageId::segment:
        return plan_segment(scene);
      case StageId::discretise:
        return plan_discretise(scene, folder);
      case StageId::solve:
        return plan_solve(scene, folder);
      case StageId::registration:
        return plan_register(scene, folder);
      case StageId::report:
        break;
    }
    return plan_report(scene, folder);
  };
  StagePlan plan = plan_own();
  if (!is_ours(scene, stage)) {
    make_external(plan, scene, folder, interruption);
  }
  return plan;
}

std::string stamp(const StagePlan& plan, InputStates& states) {
  nlohmann::ordered_json text = {{"version", BRAINSHIFT_VERSION}, {"options", plan.options}};
  for (const InputFile& input : plan.inputs) {
    text["inputs"][input.role] = states.sha256(input.path);
  }
  return sha256_of_text(json_text(text));
}

}  // namespace brainshift::pipelines
