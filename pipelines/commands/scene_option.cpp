// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/table_option.hpp"
#include "pipelines/scene/scene_table.hpp"

namespace brainshift::pipelines {

CLI::Option* add_scene_option(CLI::App& command, Scene& scene, const std::string& element_path, const std::string& name,
                              const std::string& other_flag) {
  const Element* element = find_element(element_path);
  const Option<Scene>* option = element == nullptr ? nullptr : find_option(element->options, name);
  if (option == nullptr) {
    throw std::logic_error("the scene has no option " + element_path + "." + name);
  }
  std::string flag = other_flag.empty() ? "--" + name : other_flag;
  std::replace(flag.begin(), flag.end(), '_', '-');
  Scene defaults;
  element->add(defaults);
  return add_table_option<Scene>(
      command, flag, *option,
      [&scene, element]() -> Scene& {
        element->add(scene);
        return scene;
      },
      defaults);
}

void add_stage_options(CLI::App& command, Scene& scene, const std::string& stage) {
  for (const Option<Scene>& option : find_element(stage)->options) {
    if (option.name != "command") {
      add_scene_option(command, scene, stage, option.name);
    }
  }
}

}  // namespace brainshift::pipelines
