// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "discretise/interface/node_cloud.hpp"
#include "pipelines/runner/warnings.hpp"
#include "solve/interface/model.hpp"
#include "solve/load/contradictions.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::pipelines {

/// Of points that lie off the brain's surface, that are too few or lie on a line, hardly move, move out of the head,
/// contradict their neighbours, or are lost. prescribed: what became of them, (n × 3) mm.
Warnings warnings_of(const solve::CraniotomyLoad& load, const NodeCloud& cloud, const Points& prescribed);

/// The same of those on the cortex, and of many that count as inside the brain. conditions: what became of them.
Warnings warnings_of(const solve::CraniotomyLoad& load, const NodeCloud& cloud, const solve::Conditions& conditions);

/// Of a field that does not move many of the places that it loads, as one that was masked. displacement: (n × 3) mm,
/// NaN where it says nothing.
Warnings warnings_of_held(const std::filesystem::path& file, const Points& displacement);

/// Of points that nobody can have measured so well, as where σ, (n × 3) mm or no rows, is in metres.
Warnings warnings_of_sigma(const Points& sigma);

/// Of a measured load all of them, and of a body that nothing but the load holds. displacement: what came out,
/// (n × 3) mm.
Warnings warnings_of(const solve::CraniotomyLoad& load, const solve::Model& model, const Points& displacement);

/// Of what was measured where it contradicts itself; the farthest off first. may_be_robust: robust weights, which the
/// load has not, go with it.
Warnings warnings_of(std::span<const solve::Outlier> outliers, bool may_be_robust);
Warnings warnings_of(const std::optional<solve::Outlier>& outlier, bool may_be_robust);

/// Of measured points that count for less than half.
Warnings warnings_of(const solve::LessenedPoints& lessened);

}  // namespace brainshift::pipelines
