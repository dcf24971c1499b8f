// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipelines/runner/jobs.hpp"

namespace brainshift::pipelines {

/// What run.json says of each stage's result: every field of its measures.
StageReport report_of(const segmentation::Segmentation& result);
StageReport report_of(const discretise::DiscretiseMeasures& measures);
StageReport report_of(const solve::SolveResult& result, solve::Dynamics dynamics);
StageReport report_of(const registration::Registration& result);

}  // namespace brainshift::pipelines
