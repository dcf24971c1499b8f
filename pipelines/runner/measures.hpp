// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/interface/result.hpp"
#include "pipelines/runner/stage_report.hpp"
#include "register/interface/result.hpp"
#include "segmentation/interface/result.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::pipelines {

/// What run.json says of each stage's result: sizes and measures. What only a warning tells is among the notes.
StageReport report_of(const segmentation::Segmentation& result);
StageReport report_of(const discretise::DiscretiseMeasures& measures);
StageReport report_of(const solve::SolveResult& result, solve::Dynamics dynamics);
StageReport report_of(const registration::Registration& result);

}  // namespace brainshift::pipelines
