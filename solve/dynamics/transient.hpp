// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/progress/progress.hpp"
#include "solve/dynamics/stepping.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

/// The motion itself, with the physical mass (g, one a node), by central differences over the duration of the load's
/// curve, in seconds:
///   û⁺ = û + β(û − û⁻) + α M⁻¹(f_ext − f_int),  α = 2h²/(2 + ch), β = (2 − ch)/(2 + ch),
/// then contact, then the essential conditions; c = options.damping. The step h is options.time_step or, when that is
/// 0, nine tenths of the critical step (critical_step()), which follows the stiffness reached and the fastest loss of
/// volume at a point. Throws std::invalid_argument when options.time_step is above the critical step; fails, keeping
/// what it has, when the body stiffens past it later. A run that turns unstable (points inside out, displacements that
/// are not finite, energies that do not balance) ends with its last good state; when the step is the solver's it is
/// tried once more with half.
SteppingResult march(Body body, const Course& course, const SolveOptions& options, const Progress& progress);

}  // namespace brainshift::solve
