// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/run.hpp"

#include <span>

#include "pipelines/runner/folder_lock.hpp"
#include "pipelines/runner/run_record.hpp"
#include "pipelines/runner/stage_folder.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

/// Tells of a state as of its part of the whole.
RunObserver part_of(const RunObserver& observer, const std::string& state, std::size_t ordinal, std::size_t states) {
  if (!observer) {
    return {};
  }
  return [=](RunEvent event) {
    event.state = state;
    event.total_fraction = (static_cast<double>(ordinal) + event.total_fraction) / static_cast<double>(states);
    observer(event);
  };
}

/// Whether the solve of a run's record is of its own load, although a later stage may have failed.
bool is_solved(const nlohmann::ordered_json& record) {
  const auto stages = record.find("stages");
  const auto solve = stages != record.end() ? stages->find("solve") : record.end();
  const std::string status = stages != record.end() && solve != stages->end() ? solve->value("status", "") : "";
  return status == "done" || status == "kept";
}

/// ParaView plays the solutions of the first states as steps 1, 2, ...; those of later ones may be of earlier loads.
std::string collection_of(const fs::path& out, std::span<const Scene> states) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (std::size_t i = 0; i < states.size(); ++i) {
    const fs::path solution = state_folder("", states[i].state->name) / "solve" / "solution.vtu";
    if (fs::exists(out / solution)) {
      text += "<DataSet timestep=\"" + std::to_string(i + 1) + "\" file=\"" + solution.string() + "\"/>\n";
    }
  }
  return text + "</Collection>\n</VTKFile>\n";
}

RunOutcome run_sequence(const Scene& scene, const RunOptions& options, Interruption& interruption,
                        const RunObserver& observer) {
  const fs::path out = place_of(options.out);
  const FolderLock lock(out);
  InputStates inputs;
  RunOutcome outcome{begin_run_record(scene, inputs), {}};
  outcome.record.erase("stages");
  fs::path before;
  std::size_t reached = 0;
  for (std::size_t i = 0; i < scene.states.size() && outcome.failure.empty(); ++i) {
    const Scene& state = scene.states[i];
    const std::string& name = state.state->name;
    RunOptions own = options;
    own.out = state_folder(out, name);
    const RunOutcome one =
        run_stages(state, own, before, interruption, part_of(observer, name, i, scene.states.size()));
    outcome.record["states"][name] = one.record["stages"];
    reached += one.failure.empty() || is_solved(one.record) ? 1 : 0;
    outcome.failure = one.failure.empty() ? "" : "state '" + name + "': " + one.failure;
    before = own.out;
    write_run_record(out, outcome.record, interruption);
  }
  const auto hold = interruption.hold();
  write_whole(out / "steps.pvd", collection_of(out, std::span(scene.states).first(reached)));
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
