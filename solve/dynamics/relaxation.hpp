// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "segmentation/progress.hpp"
#include "solve/boundary/contact.hpp"
#include "solve/boundary/essential_conditions.hpp"
#include "solve/dynamics/internal_force.hpp"
#include "solve/solve.hpp"

namespace brainshift::solve {

/// What dynamic relaxation moves: points and laws that resist, conditions that hold. contact may be null: then nothing
/// is stepped over.
struct System {
  const PointBlocks& points;
  std::span<const NeoHookean> laws;
  EssentialConditions& essential;
  Contact* contact;
};

/// Parameters on the way.
struct RelaxationSnapshot {
  int step;
  double time;  ///< fraction of the load
  NodalVectors parameters;
};

struct RelaxationResult {
  NodalVectors parameters;          ///< û of the last good state, mm
  Points reactions = Points(0, 3);  ///< µN
  std::vector<HistoryRow> history;
  std::vector<RelaxationSnapshot> snapshots;
  PointState state;
  int steps = 0;
  double error_bound = 0;  ///< mm
  bool unstable = false;   ///< failed because it blew up, not for want of steps
  std::string failure;     ///< empty when converged
};

/// Adaptive dynamic relaxation (Joldes, Wittek & Miller 2011) to the steady state under the full load. Steps by
///   û⁺ = û + β(û − û⁻) − α M⁻¹ f_int,  then contact, then the essential conditions,
/// with masses that give every point the same critical step, scaled to the largest eigenvalue A_m = 1 that power
/// iteration finds (should that prove unstable, once more with the bound itself). α is fixed, β = (1 − √(α A_0))² damps
/// the lowest active eigenvalue A_0 critically; it is estimated from the increments, A_0 ≈ ΔûᵀΔf/(ΔûᵀMΔû). Masses
/// follow the tangents of the state reached. Stops when the bound of the remaining error, ρ/(1 − ρ) |û⁺ − û|∞ with ρ
/// the slower of the measured rate and √β, is below the tolerance.
RelaxationResult relax(const System& system, const SolveOptions& options, const Progress& progress);

}  // namespace brainshift::solve
