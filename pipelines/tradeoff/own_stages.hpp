// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// Throws std::invalid_argument, naming its line, where discretise or solve is an external command. why: what cannot be
/// done with its settings.
inline void need_own_stages(const Scene& scene, const std::string& why) {
  for (const StageId stage : {StageId::discretise, StageId::solve}) {
    if (!scene.commands[index_of(stage)].empty()) {
      throw std::invalid_argument(place(scene.source, std::string(stage_name(stage)) + ".command") +
                                  ": the stage is an external command, " + why);
    }
  }
}

}  // namespace brainshift::pipelines
