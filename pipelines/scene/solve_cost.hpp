// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// How large the solve stage's problem will be: estimates.
struct SolveSize {
  double volume = 0;  ///< of the brain, mm³
  double nodes = 0;
  double points = 0;  ///< integration points
  double pairs = 0;   ///< (point, node)
};

/// What a part of the model makes the solver hold and do.
struct PartCost {
  std::string part;
  std::string named;  ///< path of the scene's option or element that names it; empty: there in any case
  double bytes = 0;
  double nanoseconds = 0;  ///< of one core, a step
};

/// The active parts of the solve stage, estimated from its size.
std::vector<PartCost> solve_costs(const Scene& scene, const SolveSize& size);

}  // namespace brainshift::pipelines
