// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/run.hpp"

#include <span>

#include "pipelines/runner/folder_lock.hpp"
#include "pipelines/runner/read_run_record.hpp"
#include "pipelines/runner/run_record.hpp"
#include "pipelines/runner/stage_folder.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

/// Tells of a state as of its part of the whole.
RunObserver of_state(const RunObserver& observer, const std::string& state, std::size_t ordinal, std::size_t states) {
  if (!observer) {
    return {};
  }
  return [=](RunEvent event) {
    event.state = state;
    event.total_fraction = (static_cast<double>(ordinal) + event.total_fraction) / static_cast<double>(states);
    observer(event);
  };
}

/// ParaView plays the solutions of the states as steps 1, 2, ...; not those that are of an earlier load. states: of
/// run.json.
std::string collection_of(const std::vector<Scene>& scenes, const nlohmann::ordered_json& states) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const std::string& name = scenes[i].state->name;
    const std::string status = states.value(nlohmann::json_pointer<std::string>() / name / "solve" / "status", "");
    if (status == "done" || status == "kept") {
      const fs::path solution = state_folder("", name) / "solve" / "solution.vtu";
      text += "<DataSet timestep=\"" + std::to_string(i + 1) + "\" file=\"" + solution.string() + "\"/>\n";
    }
  }
  return text + "</Collection>\n</VTKFile>\n";
}

/// Of the states from the first of `later` on, what an earlier run made of an earlier one of those before.
void outdate(std::span<const Scene> later, const fs::path& out, nlohmann::ordered_json& states,
             Interruption& interruption) {
  for (const Scene& state : later) {
    const fs::path folder = state_folder(out, state.state->name);
    auto record = read_run_record(folder);
    if (!record.is_object() || !record.contains("stages")) {
      continue;
    }
    for (const StageId stage : {StageId::solve, StageId::registration, StageId::report}) {
      const std::string name(stage_name(stage));
      if (record["stages"].contains(name)) {
        record["stages"][name]["status"] = "outdated";
      }
    }
    states[state.state->name] = record["stages"];
    write_run_record(folder, record, interruption);
  }
}

RunOutcome run_sequence(const Scene& scene, const RunOptions& options, Interruption& interruption,
                        const RunObserver& observer) {
  const fs::path out = place_of(options.out);
  const FolderLock lock(out);
  InputStates inputs;
  RunOutcome outcome{begin_run_record(scene, inputs), {}};
  outcome.record.erase("stages");
  fs::path before;
  for (std::size_t i = 0; i < scene.states.size() && outcome.failure.empty(); ++i) {
    const Scene& state = scene.states[i];
    const std::string& name = state.state->name;
    RunOptions own = options;
    own.out = state_folder(out, name);
    const std::span<const Scene> later = std::span(scene.states).subspan(i + 1);
    RunOutcome one;
    try {
      one = run_stages(state, own, before, interruption, of_state(observer, name, i, scene.states.size()));
    } catch (...) {
      outdate(later, out, outcome.record["states"], interruption);
      throw;
    }
    outcome.record["states"][name] = one.record["stages"];
    if (!one.failure.empty()) {
      outcome.failure = "state '" + name + "': " + one.failure;
      outdate(later, out, outcome.record["states"], interruption);
    }
    before = own.out;
    write_run_record(out, outcome.record, interruption);
  }
  const auto hold = interruption.hold();
  write_whole(out / "steps.pvd", collection_of(scene.states, outcome.record["states"]));
  return outcome;
}

}  // namespace

fs::path state_folder(const fs::path& out, const std::string& state) {
  return out / "states" / state;
}

RunOutcome run(const Scene& scene, const RunOptions& options, Interruption& interruption, const RunObserver& observer) {
  return scene.states.empty() ? run_stages(scene, options, {}, interruption, observer)
                              : run_sequence(scene, options, interruption, observer);
}

}  // namespace brainshift::pipelines
