// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "pipelines/commands/commands.hpp"
#include "pipelines/scene/scene_table.hpp"

namespace brainshift::pipelines {

void add_scene_option(CLI::App& command, Scene& scene, const std::string& element_path, const std::string& name) {
  const Element* element = find_element(element_path);
  const Option<Scene>* option = element == nullptr ? nullptr : find_option(element->options, name);
  if (option == nullptr) {
    throw std::logic_error("the scene has no option " + element_path + "." + name);
  }
  std::string flag = "--" + name;
  std::replace(flag.begin(), flag.end(), '_', '-');
  const auto set = [&scene, element, option, flag](const std::string& value) {
    element->add(scene);
    if (!option->set(scene, value)) {
      throw CLI::ValidationError(flag, "is '" + value + "', but must be " + option->allowed +
                                           (option->unit.empty() ? "" : " (" + option->unit + ")"));
    }
  };
  Scene defaults;
  element->add(defaults);
  const std::string standard = option->get(defaults);
  command.add_option_function<std::string>(flag, set, option->help)
      ->type_name(option->is_path ? "FILE" : option->allowed + (option->unit.empty() ? "" : ", " + option->unit))
      ->default_str(standard);
}

}  // namespace brainshift::pipelines
