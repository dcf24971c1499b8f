// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/presets.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace brainshift::pipelines {
namespace {

struct Preset {
  const char* name;
  const char* use;
  const char* nodes;
  const char* tolerance;
};

constexpr std::array<Preset, 3> presets = {{
    {"fast", "a first look", "1500", "0.1"},
    {"balanced", "most work", "6000", "0.01"},
    {"accurate", "a reference", "24000", "0.01"},
}};

}  // namespace

std::string preset_names() {
  std::string names;
  for (const Preset& preset : presets) {
    names += (names.empty() ? "" : " | ") + std::string(preset.name);
  }
  return names;
}

std::string preset_help() {
  std::string help;
  for (const Preset& preset : presets) {
    help += (help.empty() ? "" : ", ") + std::string(preset.name) + " (" + preset.use + ")";
  }
  return help;
}

std::vector<std::string> preset_overrides(const std::string& name, const std::vector<std::string>& given) {
  std::vector<std::string> overrides;
  if (!name.empty()) {
    const auto* preset = std::ranges::find(presets, name, &Preset::name);
    if (preset == presets.end()) {
      throw std::invalid_argument("--preset is '" + name + "', but must be " + preset_names());
    }
    overrides = {"discretise.spacing=",        std::string("discretise.nodes=") + preset->nodes,
                 "solve.points_per_cell=auto", "solve.integration_tolerance=0",
                 "solve.basis=linear",         "solve.derivatives=full",
                 "solve.precision=single",     std::string("solve.tolerance=") + preset->tolerance};
  }
  overrides.insert(overrides.end(), given.begin(), given.end());
  return overrides;
}

}  // namespace brainshift::pipelines
