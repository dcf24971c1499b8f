// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/each/relax_together_if_asked.hpp"

#include <string>

#include "solve/device/backend.hpp"
#include "solve/device/each/device_ensemble.hpp"
#include "solve/device/each/relax_together.hpp"
#include "solve/device/where_asked.hpp"

namespace brainshift::solve::device {

std::optional<std::vector<MemberResult>> relax_together_if_asked(const Body& body, std::span<const Member> loads,
                                                                 const LoadCurve& curve, const SolveOptions& options,
                                                                 const Progress& progress) {
  if (loads.empty()) {
    return std::nullopt;
  }
  const auto why_not = [&] {
    const std::string none = why_no_gpu();
    const std::string of_body = none.empty() ? why_not_together(body, loads) : "";
    return of_body.empty() ? none : "a GPU cannot solve this body, which " + of_body;
  };
  return where_asked(options.device, "device", why_not, progress,
                     [&] { return relax_together(*gpu(), body, loads, curve, options, progress); });
}

}  // namespace brainshift::solve::device
