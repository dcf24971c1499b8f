// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/run_record.hpp"

#include "pipelines/runner/json_text.hpp"
#include "pipelines/runner/libraries.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/scene/describe_scene.hpp"
#include "pipelines/scene/scene_labels.hpp"
#include "segmentation/files/whole_path.hpp"

namespace brainshift::pipelines {

nlohmann::ordered_json begin_run_record(const Scene& scene, InputStates& states) {
  nlohmann::ordered_json inputs = nlohmann::ordered_json::array();
  for (const InputFile& file : scene_files(scene)) {
    inputs.push_back(
        {{"role", file.role}, {"path", whole_path(file.path).string()}, {"sha256", states.sha256(file.path)}});
  }
  nlohmann::ordered_json names = nlohmann::ordered_json::object();
  for (const auto& [label, name] : label_names(scene)) {
    names[std::to_string(label)] = name;
  }
  nlohmann::ordered_json record = {{"version", BRAINSHIFT_VERSION},
                                   {"scene", whole_path(scene.source.file).string()},
                                   {"scene_sha256", states.sha256(scene.source.file)},
                                   {"inputs", std::move(inputs)},
                                   {"options", effective_options(scene)},
                                   {"label_names", std::move(names)},
                                   {"threads", threads_in_use()},
                                   {"stages", nlohmann::ordered_json::object()}};
  if (scene.state) {
    record["state"] = scene.state->name;
  }
  return record;
}

void write_run_record(const std::filesystem::path& out, const nlohmann::ordered_json& record,
                      Interruption& interruption) {
  const auto hold = interruption.hold();
  write_whole(out / "run.json", json_text(record));
}

}  // namespace brainshift::pipelines
