// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// The nominal stress-strain curve of a body that is pulled one way, at one end: along the mean prescribed displacement
/// of its loaded nodes; empty of another. In relaxation of the states at rest (residual_at_rest) and of the last:
/// others hold fictitious inertia.
std::vector<StressStrainRow> stress_strain(const Model& model, Dynamics dynamics,
                                           const std::vector<HistoryRow>& history);

/// Header time,elongation,stress_Pa.
void write_stress_strain(const std::filesystem::path& file, const std::vector<StressStrainRow>& rows);

}  // namespace brainshift::solve
