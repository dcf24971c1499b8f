// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <optional>

#include "segmentation/progress/progress.hpp"
#include "solve/dynamics/stepping.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

/// A state counts as one at rest when the HistoryRow::residual of its row and those before, so many in all, is at most
/// this: a low alone may be a turning point. Reactions are then about as true.
inline constexpr double residual_at_rest = 0.02;
inline constexpr int rows_of_rest = 4;

/// Of the largest displacement: the error that may be left, whatever the tolerance.
inline constexpr double open_part = 0.02;

/// What moves no farther does not move, mm: a rigid motion that is taken out of what was measured leaves 1e-13 mm.
inline constexpr double no_motion = 1e-9;

/// The bound of the error that is wanted, mm, with the largest displacement so far: of a small load's answer not more
/// than a small part is left open.
inline double wanted_bound(double tolerance, double farthest) {
  return farthest > no_motion ? std::min(tolerance, open_part * farthest) : tolerance;
}

/// How many rows up to one with this residual are calm, from how many up to the one before.
inline int calm_rows(int before, double residual) {
  return residual <= residual_at_rest ? before + 1 : 0;
}

/// relax() once, with the masses from the bound of the stiffness itself where `cautious`; nothing: it is to be done
/// here. The body is moved into the result, else kept.
using RelaxElsewhere = std::function<std::optional<SteppingResult>(
    Body& body, const Course& course, const SolveOptions& options, bool cautious, const Progress& progress)>;

/// Adaptive dynamic relaxation (Joldes, Wittek & Miller 2011) to the steady state under the full load. Steps by
///   û⁺ = û + β(û − û⁻) + α M⁻¹ (f_ext − f_int),  then contact, then the essential conditions,
/// with the bound of the stiffness as mass, scaled to the largest eigenvalue A_m = 1 that power iteration finds (should
/// that prove unstable, once more with the bound itself). α is fixed, β = (1 − √(α A_0))² damps
/// the lowest active eigenvalue A_0 critically; it is estimated from the increments, A_0 ≈ ΔûᵀΔf/(ΔûᵀMΔû). Masses
/// follow the tangents of the state reached. The load's curve is run through in steps_of_load(), of a body that may
/// tear more slowly where it would else not be at rest, and hardly on while a tear runs. Stops when the bound of the
/// remaining error, METHOD.md (23) and what follows it there, is below the tolerance.
/// elsewhere: what may do it in place of this processor.
SteppingResult relax(Body body, const Course& course, const SolveOptions& options, const Progress& progress,
                     const RelaxElsewhere& elsewhere = {});

}  // namespace brainshift::solve
