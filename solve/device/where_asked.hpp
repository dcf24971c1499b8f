// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <type_traits>

#include "segmentation/progress/progress.hpp"
#include "solve/device/device_fault.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve::device {

/// What on_gpu() gives where the device asked for is a GPU; nothing: it is the processor's, or left to it, which
/// progress is told with the reason. option: of the device, for the message. why_not(): why a GPU cannot, as a
/// sentence; empty: it can. Throws NotOnDevice where nothing but a GPU is asked for and it cannot, DeviceFault where it
/// fails then, and as on_gpu() does.
template <class WhyNot, class OnGpu>
std::optional<std::invoke_result_t<OnGpu>> where_asked(Device asked, const std::string& option, const WhyNot& why_not,
                                                       const Progress& progress, const OnGpu& on_gpu) {
  if (asked == Device::cpu) {
    return std::nullopt;
  }
  const bool only_gpu = asked == Device::cuda;
  if (const std::string why = why_not(); !why.empty()) {
    if (only_gpu) {
      throw NotOnDevice(option + " cuda: " + why + "; take cpu, or auto");
    }
    report(progress, 0, "on the processor: " + why);
    return std::nullopt;
  }
  try {
    return on_gpu();
  } catch (const DeviceFault& fault) {
    if (only_gpu) {
      throw;
    }
    report(progress, 0, std::string("once more on the processor: ") + fault.what());
    return std::nullopt;
  }
}

}  // namespace brainshift::solve::device
