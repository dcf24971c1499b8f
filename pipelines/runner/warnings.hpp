// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "discretise/interface/node_cloud.hpp"
#include "pipelines/runner/stage_report.hpp"
#include "register/interface/result.hpp"
#include "solve/interface/model.hpp"
#include "solve/load/contradictions.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::pipelines {

/// What is no fault, but most likely not what the user means: a sentence each.
using Warnings = std::vector<std::string>;

/// Of points that lie off the brain's surface, that are too few or lie on a line, hardly move, move out of the head,
/// contradict their neighbours, or are lost. prescribed: what became of them.
Warnings warnings_of(const solve::CraniotomyLoad& load, const NodeCloud& cloud, const Points& prescribed);

/// The same of those on the cortex, and of many that count as inside the brain. conditions: what became of them.
Warnings warnings_of(const solve::CraniotomyLoad& load, const NodeCloud& cloud, const solve::Conditions& conditions);

/// Of labels that lie where a T1 of the same grid is black, or whose boundary is none in it: it is of another head or
/// frame.
Warnings warnings_of(const ScalarImage& t1, const LabelMap& labels, std::span<const std::uint16_t> brain);

/// Of a body that nothing but its measured load, on less than half of its surface, holds. displacement: what came out,
/// (n × 3) mm.
Warnings warnings_of(const solve::Model& model, const Points& displacement);

void append(const Warnings& more, Warnings& warnings);

/// Two digits, of large numbers all before the point.
std::string with_digits(double number);

/// Of points that nobody can have measured so well, as where σ is in metres.
Warnings warnings_of_sigma(const Points& sigma);

/// Of a measured load all of them.
Warnings warnings_of(const solve::CraniotomyLoad& load, const solve::Model& model, const Points& displacement);

/// Of a head that is weighed as if it did not float.
Warnings warnings_of_weight(const solve::Model& model);

/// Of a brain that has turned in its skull, where it slides without friction, and of an answer that is hardly larger
/// than its estimated error. Without a measured load a turn that is no small one is no answer: turn_fault().
Warnings warnings_of(const solve::Model& model, const Solution& solution);

/// Empty, or why a body that nothing but contact holds has no answer: fluid that drains or tissue that swells as the
/// image has it goes along with a brain that turns, and turns it on.
std::string turn_fault(const solve::Model& model, const Solution& solution);

/// Of levels of the fluid above the brain.
Warnings warnings_of_levels(const solve::Model& model);

/// Of soft tissue, as fluid is modelled, that a drained level leaves with its whole weight.
Warnings warnings_of_rooms(const solve::Model& model);

/// Of what was measured where it contradicts itself; the farthest off first. may_be_robust: robust weights, which the
/// load has not, go with it.
Warnings warnings_of(std::span<const solve::Outlier> outliers, bool may_be_robust);
Warnings warnings_of(const std::optional<solve::Outlier>& outlier, bool may_be_robust);

/// Of measured points that count for less than half.
Warnings warnings_of(const solve::LessenedPoints& lessened);

/// Of a field that folds, and of landmarks outside the image or in what was taken out.
Warnings warnings_of(const registration::RegisterMeasures& measures);

/// Adds them to the notes of a stage, each marked as a warning.
void warn(const Warnings& warnings, std::vector<std::string>& notes);
void warn(const Warnings& warnings, StageReport& report);

}  // namespace brainshift::pipelines
