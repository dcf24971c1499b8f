// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/update_run.hpp"

#include "pipelines/checksum/sha256.hpp"
#include "pipelines/runner/impose.hpp"
#include "pipelines/runner/load_warnings.hpp"
#include "pipelines/runner/measure_warnings.hpp"
#include "pipelines/runner/measures.hpp"
#include "pipelines/runner/plan.hpp"
#include "pipelines/runner/read_run_record.hpp"
#include "pipelines/runner/stage_record.hpp"
#include "pipelines/scene/describe_scene.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "segmentation/files/make_folder.hpp"
#include "segmentation/files/naming.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/whole_path.hpp"
#include "solve/body/nodal_order.hpp"
#include "solve/device/kept_on_device.hpp"
#include "solve/load/noisy_load.hpp"
#include "solve/output/solution_file.hpp"
#include "solve/run/outliers.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

nlohmann::ordered_json record_of(const fs::path& run) {
  auto record = read_run_record(run);
  if (!record.is_object() || !record.contains("scene") || !record["scene"].is_string() || !record.contains("version") ||
      !record["version"].is_string() || !record.contains("options") || !record["options"].is_object() ||
      !record.contains("inputs") || !record["inputs"].is_array()) {
    refuse(run, "this is no run: it has no run.json that can be read; make one with 'brainshift run SCENE --out DIR'");
  }
  if (record.contains("state") || record.contains("states")) {
    refuse(run,
           "the run cannot be updated: it is of a sequence; change the state's load in the scene and run it again, "
           "which keeps the states before it");
  }
  if (record["version"] != BRAINSHIFT_VERSION) {
    refuse(run, "the run was made by version " + record["version"].get<std::string>() + ", this is " +
                    BRAINSHIFT_VERSION + "; run its scene again");
  }
  return record;
}

/// Where the record's options are others than the scene's own: what --set and a preset changed, elements that the file
/// does not have among it.
void add_changes(const std::string& path, const nlohmann::ordered_json& now, const nlohmann::ordered_json& then,
                 std::vector<std::string>& overrides) {
  for (const auto& [name, value] : then.items()) {
    const bool there = now.is_object() && now.contains(name);
    const std::string place = path.empty() ? name : path + "." + name;
    if (value.is_object()) {
      add_changes(place, there ? now[name] : nlohmann::ordered_json(), value, overrides);
    } else if (value.is_string() && (there ? now[name] != value : !value.get<std::string>().empty())) {
      overrides.push_back(place + "=" + value.get<std::string>());
    }
  }
}

/// The scene as it was run: its file, and what the command line put on top.
Scene scene_of(const nlohmann::ordered_json& record) {
  const fs::path file = record["scene"].get<std::string>();
  if (!record.contains("scene_sha256")) {
    refuse(file, "the run was made by an earlier build of this version, which did not note its scene; run it again");
  }
  if (record["scene_sha256"] != sha256_of_file(file)) {
    refuse(file, "the scene has changed since the run was made; run it again");
  }
  std::vector<std::string> overrides;
  for (const auto& input : record["inputs"]) {
    const std::string role = input.value("role", "");
    if (!role.starts_with("cuts.")) {
      overrides.push_back(role + "=" + input.value("path", ""));
    }
  }
  add_changes("", effective_options(parse_scene(file, overrides)), record["options"], overrides);
  return parse_scene(file, overrides);
}

/// All that the solution depends on: labels that the T1 is not classified into do without it, and no load is weighed by
/// landmarks (where their deviations are asked for, the stamp of the solve has them).
void check_inputs(const nlohmann::ordered_json& record, const Scene& scene) {
  for (const auto& input : record["inputs"]) {
    const std::string role = input.value("role", "");
    const bool counts = role != "landmarks.file" && (role != "image.t1" || !scene.image.brain_mask.empty());
    if (counts && !is_unchanged(input)) {
      refuse(input.value("path", ""), "it has changed since the run was made; run the scene again");
    }
  }
}

StageRecord finished_solve(const fs::path& run) {
  const std::optional<StageRecord> record = read_stage_record(run / "solve");
  if (!record || !record->failure.empty() || !fs::exists(run / "solve" / "solution.vtu")) {
    refuse(run, "the run is not finished: its solve stage " +
                    std::string(record && !record->failure.empty() ? "did not converge" : "is not there") +
                    "; run its scene again");
  }
  return *record;
}

constexpr std::string_view in_double = "double precision";  // which an update takes, too

std::string took_of(const StageRecord& solved) {
  return solved.entry.value("/measures/took"_json_pointer, "");
}

void refuse_what_cannot(const fs::path& run, const Scene& scene, const StageRecord& solved) {
  if (!is_ours(scene, StageId::solve)) {
    refuse(run, "the run cannot be updated: another program solved it");
  }
  if (!scene.load || scene.load->empty()) {
    refuse(run, "the run cannot be updated: its scene has no <load>");
  }
  if (scene.load->robust) {
    refuse(run, "the run cannot be updated: its load has robust weights; run a scene with the new load");
  }
  if (scene.load->registration_unknown) {
    refuse(run, "the run cannot be updated: its registration is unknown; run a scene with the new load");
  }
  if (scene.load->field && scene.load->noise) {
    refuse(run, "the run cannot be updated: its load is a field with noise; run a scene with the new one");
  }
  const std::string took = took_of(solved);
  if (!took.empty() && took != in_double && !took.ends_with(" load steps")) {  // an update's load does not come slowly
    refuse(run,
           "the run cannot be updated: it took " + took + ", which an update would not; run a scene with the new load");
  }
}

}  // namespace

UpdatedRun::UpdatedRun(const fs::path& run, Interruption& interruption, const Progress& progress,
                       std::optional<solve::Device> device)
    : run_(whole_path(run)), file_(run_ / "update" / "kept.bin") {
  const nlohmann::ordered_json record = record_of(run_);
  const StageRecord solved = finished_solve(run_);
  scene_ = scene_of(record);
  refuse_what_cannot(run_, scene_, solved);
  check_inputs(record, scene_);
  InputStates states;
  if (stamp(plan_stage(StageId::solve, scene_, run_, interruption), states) != solved.stamp) {
    refuse(run_, "the scene or a file of the run has changed since it was solved; run the scene again");
  }
  key_ = sha256_of_text(solved.stamp + sha256_of_file(run_ / "solve" / "solution.vtu"));
  SolveJob job = solve_job(scene_, run_);
  if (took_of(solved) == in_double) {
    job.options.precision = solve::Precision::double_precision;
  }
  how_ = *job.load;
  landmarks_ = job.landmarks.empty() ? Points(0, 3) : solve::read_markup_positions(job.landmarks);
  if (auto kept = solve::read_kept(file_, key_, job.materials, job.options)) {
    kept_ = std::move(*kept);
  } else {
    make_kept(job, progress);
  }
  kept_.made_from = [job]() mutable {
    job.load.reset();  // its file may be the one that is measured anew
    return read_input(job).model;
  };
  kept_.options.device = device.value_or(kept_.options.device);
}

void UpdatedRun::make_kept(const SolveJob& job, const Progress& progress) {
  const SolveInput input = read_input(job);
  const Solution solution = read_solution(run_ / "solve" / "solution.vtu");
  if (const std::string why = solve::cannot_keep(input.model, input.options); !why.empty()) {
    refuse(run_, "the run cannot be updated: " + why + "; run a scene with the new load");
  }
  if (solution.positions.rows() != input.model.cloud.positions.rows() ||
      solution.positions != input.model.cloud.positions) {
    refuse(run_ / "solve" / "solution.vtu",
           "its nodes are not those of the run's cloud: another program made it, or it was replaced; run the scene "
           "again, from the solve stage on");
  }
  report(progress, 0, "preparing the run for other loads");
  kept_ =
      naming(run_.string(), [&] { return solve::keep(input.model, input.options, solution.displacement, progress); });
  try {
    make_folder(file_.parent_path());
    solve::write_kept(file_, kept_, key_);
  } catch (const std::runtime_error& error) {
    not_kept_ = error.what();
  }
}

solve::CraniotomyLoad UpdatedRun::read(const fs::path& file) const {
  solve::CraniotomyLoad load = solve::read_craniotomy_csv(file);
  if (!kept_.thinned && load.sigma.rows() > 0) {
    refuse(file,
           "it has standard deviations, but the run's load was met exactly; leave the columns sigma out, or run "
           "a scene with this load");
  }
  if (kept_.thinned) {
    add_noise(how_, load);
    if (load.sigma.rows() == 0) {
      refuse(file,
             "it has no standard deviations, but those of the run's load were in its file; add a column sigma, or run "
             "a scene with this load");
    }
  }
  return load;
}

NodeCloud UpdatedRun::cloud() const {
  return {.positions = kept_.fine.body.positions, .spacing = kept_.fine.body.spacing, .on_surface = kept_.on_surface};
}

Points UpdatedRun::parameters() const {
  return solve::in_cloud_order(kept_.fine.parameters, kept_.fine.body.original);
}

std::string UpdatedRun::device_fault() const {
  return kept_.on_device ? kept_.on_device->fault() : std::string();
}

solve::SolveResult UpdatedRun::solve(const solve::CraniotomyLoad& load, const fs::path& file,
                                     const Progress& progress) {
  return solve_and_ask(load, file, Points(0, 3), progress);
}

solve::SolveResult UpdatedRun::solve_and_ask(const solve::CraniotomyLoad& load, const fs::path& file,
                                             const Points& places, const Progress& progress) {
  return naming(file.string(), [&] {
    solve::Conditions conditions = imposed(load, how_, cloud());
    if (conditions.measured) {
      conditions.measured->asked = places;
    }
    solve::SolveResult result = solve::update(kept_, conditions, progress);
    answered_ = {load, std::move(conditions)};
    return result;
  });
}

solve::SolveResult UpdatedRun::answer_own_load(const Progress& progress) {
  if (kept_.thinned) {
    const fs::path file = run_ / "solve" / "load.csv";
    return solve(read(file), file, progress);
  }
  return solve::update(kept_, kept_.origin.prescribed, progress);
}

Warnings UpdatedRun::warnings() const {
  const auto& [load, conditions] = answered_;
  Warnings all;
  if (conditions.measured) {
    append(warnings_of(solve::worst_of_joined(load, solve::inner_points(cloud(), load)), false), all);
    append(warnings_of(solve::outliers(*kept_.thinned, conditions), false), all);
  }
  if (scene_.load->field) {
    all.emplace_back(
        "the run's load is a field, which loads its own nodes; the update took the points for those of an opening, as "
        "<craniotomy> does, which differs most at the rim");
  }
  append(warnings_of_sigma(load.sigma), all);
  append(warnings_of(load, cloud(), conditions), all);
  return all;
}

StageReport UpdatedRun::answer(const fs::path& file, const fs::path& out, const Progress& progress) {
  const solve::CraniotomyLoad load = read(file);
  const solve::SolveResult result = solve_and_ask(load, file, landmarks_, progress);
  solve::write_solve(out, result);
  solve::write_craniotomy_csv(out / "load.csv", load);
  if (result.measures.measured && landmarks_.rows() > 0) {
    write_covariance(out / "uncertainty.csv", landmarks_, result);
  }
  StageReport said = report_of(result, solve::Dynamics::relaxation);
  for (const char* of_setup :
       {"outside_label", "consistency_iterations", "grown_supports", "seconds_setup"}) {  // the run's record has it
    said.measures.erase(of_setup);
  }
  if (scene_.uncertainty) {
    said.notes.emplace_back(
        "an update draws no samples: what constants that nobody knows add to the uncertainty is that of the run");
  }
  if (!not_kept_.empty()) {
    said.notes.push_back("warning: the next update prepares the run again: " + not_kept_);
  }
  warn(warnings_of(result.measures), said);
  warn(warnings(), said);
  return said;
}

}  // namespace brainshift::pipelines
