// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/commands/commands.hpp"
#include "pipelines/scene/scene_table.hpp"

namespace brainshift::pipelines {

CLI::Option* add_device_option(CLI::App& command, std::optional<solve::Device>& device) {
  static constexpr const char* flag = "--device";
  const Option<Scene>& option = *find_option(find_element("solve")->options, "device");
  const auto set = [&option, &device](const std::string& value) {
    Scene scene;
    if (!set_option(option, scene, value)) {
      throw CLI::ValidationError(flag, refusal(option, value));
    }
    device = scene.solve.device;
  };
  return command
      .add_option_function<std::string>(flag, set,
                                        "what answers: the processor, an NVIDIA GPU, or that where there is "
                                        "one that can; as the run was solved if absent")
      ->type_name(option.allowed);
}

}  // namespace brainshift::pipelines
