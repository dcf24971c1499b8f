// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipelines/runner/interruption.hpp"
#include "pipelines/scene/scene.hpp"
#include "pipelines/tradeoff/choices.hpp"
#include "solve/output/field_difference.hpp"

namespace brainshift::pipelines {

/// What one choice of settings costs and buys.
struct TradeoffPoint {
  Choice choice;
  std::string failure;  ///< empty, or why there is no solution; the numbers are then void
  std::size_t nodes = 0;
  std::size_t points = 0;  ///< integration points
  int steps = 0;
  double solve_seconds = 0;      ///< of the solve stage, files included
  double whole_seconds = 0;      ///< of all stages: register and report as timed once, with the scene's own settings
  solve::FieldDifference error;  ///< from the reference, at its nodes
  double landmark_error = 0;     ///< largest at the scene's landmarks, mm; NaN when it has none
};

struct Sweep {
  Choice reference;
  std::vector<TradeoffPoint> points;  ///< in the order of all_choices()
};

/// Told after each point: how many are done, of how many, and the last one.
using SweepObserver = std::function<void(std::size_t done, std::size_t all, const TradeoffPoint& point)>;

/// Solves the scene with every choice of its lists and with the reference, one after the other, below `out`:
/// reference/, scene/ (with its own settings) and run/ are folders of runs, points/NAME.json keeps what was measured.
/// What is there already, made by the same version from the same scene and files, is not done again. A choice that
/// cannot be solved is a point with a failure. overrides: of the scene, before the choice's own. Throws
/// std::invalid_argument when the scene is at fault and std::runtime_error when the reference does not converge.
Sweep sweep(const std::filesystem::path& scene, const std::vector<std::string>& overrides,
            const std::filesystem::path& out, Interruption& interruption, const SweepObserver& observer);

}  // namespace brainshift::pipelines
