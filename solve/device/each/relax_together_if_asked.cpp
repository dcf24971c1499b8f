// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/each/relax_together_if_asked.hpp"

#include <string>

#include "solve/device/backend.hpp"
#include "solve/device/device_fault.hpp"
#include "solve/device/each/device_ensemble.hpp"
#include "solve/device/each/relax_together.hpp"

namespace brainshift::solve::device {

std::optional<std::vector<MemberResult>> relax_together_if_asked(const Body& body, std::span<const Member> loads,
                                                                 const LoadCurve& curve, const SolveOptions& options,
                                                                 const Progress& progress) {
  if (options.device == Device::cpu || loads.empty()) {
    return std::nullopt;
  }
  std::string why = why_no_gpu();
  if (why.empty()) {
    const std::string of_body = why_not_together(body, loads);
    why = of_body.empty() ? of_body : "a GPU cannot solve this body, which " + of_body;
  }
  if (!why.empty()) {
    if (options.device == Device::cuda) {
      throw NotOnDevice("device cuda: " + why + "; take cpu, or auto");
    }
    report(progress, 0, "on the processor: " + why);
    return std::nullopt;
  }
  try {
    return relax_together(*gpu(), body, loads, curve, options, progress);
  } catch (const DeviceFault& fault) {
    if (options.device == Device::cuda) {
      throw;
    }
    report(progress, 0, std::string("once more on the processor: ") + fault.what());
    return std::nullopt;
  }
}

}  // namespace brainshift::solve::device
