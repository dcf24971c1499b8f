// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "pipelines/report/slice_figures.hpp"

namespace brainshift::pipelines {

/// Misfit against energy of the weights that were tried for a load with noise, and the one that was taken. measures: of
/// the solve stage in run.json. None where no weights were tried.
std::vector<Figure> weight_figures(const nlohmann::json& measures);

}  // namespace brainshift::pipelines
