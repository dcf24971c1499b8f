// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/stage_inputs.hpp"

#include <algorithm>

#include "pipelines/scene/describe_scene.hpp"
#include "pipelines/scene/scene_table.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;

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

std::vector<std::string> elements_of_load(const Scene& scene) {
  std::vector<std::string> names;
  for (const Element& element : scene_elements()) {
    if ((element.path == "load" || element.path.starts_with("load.")) && element.present(scene)) {
      names.push_back(element.path);
    }
  }
  return names;
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

fs::path if_there(const fs::path& file) {
  return fs::exists(file) ? file : fs::path();
}

void add_artefacts(std::vector<InputFile>& inputs, const fs::path& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (fs::exists(folder / name)) {
      inputs.push_back({name, folder / name});
    }
  }
}

}  // namespace brainshift::pipelines
