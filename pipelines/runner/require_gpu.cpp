// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/require_gpu.hpp"

#include <string>

#include "solve/device/device_fault.hpp"
#include "solve/device/gpu.hpp"

namespace brainshift::pipelines {

void require_gpu(const Scene& scene, StageId from, StageId until) {
  const auto check = [&](StageId stage, solve::Device device) {
    const bool asked = device == solve::Device::cuda && stage >= from && stage <= until && is_active(stage, scene) &&
                       is_ours(scene, stage);
    if (const std::string why = asked ? solve::device::why_no_gpu() : ""; !why.empty()) {
      throw solve::device::NotOnDevice(std::string(stage_name(stage)) + ".device cuda: " + why + "; take cpu, or auto");
    }
  };
  check(StageId::solve, scene.solve.device);
  check(StageId::registration, scene.registration.device);
}

}  // namespace brainshift::pipelines
