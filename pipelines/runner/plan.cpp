// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/plan.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "pipelines/checksum/sha256.hpp"
#include "pipelines/report/report.hpp"
#include "pipelines/runner/external_stage.hpp"
#include "pipelines/runner/json_text.hpp"
#include "pipelines/scene/check_parts.hpp"
#include "pipelines/scene/describe_scene.hpp"
#include "pipelines/scene/field_load.hpp"
#include "pipelines/scene/tissue_table.hpp"
#include "solve/material/material.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

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
  constexpr double threefold = 3;
  std::set<std::pair<std::int32_t, std::int32_t>> alike;
  for (const Tissue& a : tissues) {
    for (const Tissue& b : tissues) {
      const double of_a = solve::shear_modulus(a.material), of_b = solve::shear_modulus(b.material);
      if (a.label < b.label && !solve::is_times(threefold, of_a, of_b) && !solve::is_times(threefold, of_b, of_a)) {
        alike.emplace(a.label, b.label);
      }
    }
  }
  return alike;
}

std::vector<std::uint16_t> resected_labels(const Scene& scene) {
  return {scene.resection->labels.begin(), scene.resection->labels.end()};
}

/// The wall of what is resected.
fs::path wall_of(const Scene& scene, const fs::path& folder) {
  return scene.resection ? if_there(folder / "segment" / "resection.vtp") : fs::path();
}

/// The same where the cells are parted by it: another discretiser knows no wall.
fs::path wall_of_cells(const Scene& scene, const fs::path& folder) {
  return is_ours(scene, StageId::discretise) ? wall_of(scene, folder) : fs::path();
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
    const auto load = elements_of_load(scene);
    plan.inputs = files_of(scene, load);
    plan.options["load"] = options_of(scene, load);
  }
  plan.options["brain_labels"] = labels;
  plan.options["alike"] = job.options.alike;
  add_artefacts(plan.inputs, folder, {"segment/brain.vtp", "segment/labels.nii.gz"});
  job.wall = wall_of_cells(scene, folder);
  if (!job.wall.empty()) {
    job.resected = scene.resection->labels;
    plan.options["resected"] = job.resected;
    add_artefacts(plan.inputs, folder, {"segment/resection.vtp"});
  }
  plan.work = [job](const fs::path& out, const Progress& progress) { return run_job(job, out, progress); };
  return plan;
}

/// A load with noise tells how well it knows the landmarks, and so do samples.
bool asks_for_landmarks(const Scene& scene) {
  return scene.landmarks && ((scene.load && has_noise(*scene.load)) || scene.uncertainty);
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
  std::vector<std::string> elements = elements_of_load(scene);
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
  add_artefacts(plan.inputs, folder,
                {"discretise/nodes.vtu", "discretise/cells.vtu", "segment/brain.vtp", "segment/labels.nii.gz"});
  if (scene.load && scene.load->field) {
    plan.options["field_moves_points"] = direction_of(*scene.load->field) == registration::Moves::points;
  }
  if (scene.contact && scene.contact->skull.empty()) {
    add_artefacts(plan.inputs, folder, {"segment/skull.vtp"});
  }
  if (scene.septa) {
    add_artefacts(plan.inputs, folder, {"segment/septa.vtp"});
  }
  if (!job.wall.empty()) {
    add_artefacts(plan.inputs, folder, {"segment/resection.vtp"});
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
  add_artefacts(plan.inputs, folder,
                {"solve/solution.vtu", "solve/uncertainty.vtu", "segment/brain.vtp", "segment/labels.nii.gz"});
  if (!wall.empty()) {
    plan.options["resected"] = job.resected;
    add_artefacts(plan.inputs, folder, {"segment/resection.vtp"});
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
               .wall = wall_of_cells(scene, folder),
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
  const auto takes_all_numbers = [](const Tissue& tissue) { return tissue.tissue_class == 0 && tissue.labels.empty(); };
  if (std::ranges::all_of(scene.tissues, takes_all_numbers)) {
    job.other_labels.emplace(scene.image.other_labels.begin(), scene.image.other_labels.end());
    job.other_labels->insert(scene.image.skull_label.value_or(0));
  }
  if (scene.uncertainty) {
    job.uncertainty = uncertainty_job(scene, folder);
  }
  return job;
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
