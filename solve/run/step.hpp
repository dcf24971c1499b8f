// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/progress/progress.hpp"
#include "solve/dynamics/stepping.hpp"
#include "solve/run/prepare.hpp"

namespace brainshift::solve {

/// Steps what was prepared to the end. measures: as prepare() left them; the rest is filled in. start: û to relax from
/// under the full load; empty: from rest.
SolveResult step_to_end(const Model& model, const SolveOptions& options, Prepared prepared, SolveMeasures measures,
                        NodalVectors start, const Progress& progress);

/// Where there is a cut: its faces, at the end and at each snapshot. inside: of the body that was stepped.
void draw_faces(const InsideBody& inside, SolveResult& result);

/// What a body that was stepped says of itself, without cuts. measures: the rest is filled in.
SolveResult result_of(SteppingResult& stepped, const SolveOptions& options, SolveMeasures measures);

}  // namespace brainshift::solve
