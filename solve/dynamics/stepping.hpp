// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/body/body.hpp"
#include "solve/dynamics/body_change.hpp"
#include "solve/dynamics/diagnosis.hpp"
#include "solve/force/internal_force.hpp"
#include "solve/interface/load_curve.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// What relaxation has found out about a body on the way to rest.
struct Settled {
  std::vector<double> mass;      ///< fictitious, one a node
  double mass_scale = 1;         ///< of the stiffness bound
  double lowest = 1e-4;          ///< A_0 that it is damped by
  double of_rigid = 0;           ///< A_0 of its slowest rigid motion, where it is damped by more; else 0
  double smallest_jacobian = 1;  ///< of the state that the masses follow
};

/// What of the nodes the bound of the error is read off. û of a node that hardly counts anywhere, as at a rim, may move
/// forty times as far as u. û costs no sums: a GPU goes by it, and the state of rest that updates start from.
enum class BoundOf : std::uint8_t { displacement, parameters };

/// What a bound is multiplied by. û shows slow motions sooner than u: of 750 random problems three stopped farther off
/// than a bound of u says without this, one does with it, and none that goes by û.
constexpr double margin_of(BoundOf bound) {
  return bound == BoundOf::displacement ? 1.5 : 1;
}

/// What happens to a body while it is stepped.
struct Course {
  LoadCurve curve;          ///< of the prescribed displacements and of the forces
  NodalVectors start = {};  ///< û of a coarse solution under the full load; empty: from rest
  BodyChange change = {};   ///< empty: the body stays whole
  /// Of the same body at rest under another load: the start is then near the end. Absent: not known yet.
  std::optional<Settled> settled = {};
  BoundOf bound = BoundOf::displacement;
  bool goes_on = false;  ///< from where another relaxation has come to: the start's quick motions have died down

  /// Whether the start is full of quick motions.
  bool starts_roughly() const { return !start.empty() && !settled && !goes_on; }
};

/// What time stepping leaves behind.
struct SteppingResult {
  Body body;                        ///< as it was at the end
  NodalVectors parameters;          ///< û of the last good state, mm
  Points reactions = Points(0, 3);  ///< µN
  Settled settled;                  ///< relaxation only
  std::vector<HistoryRow> history;
  std::vector<Snapshot> snapshots;
  PointState state;
  int steps = 0;
  double fraction = 0;         ///< of the load, at the last good state
  double error_bound = 0;      ///< mm; relaxation only
  double critical_step = 0;    ///< s, of the undeformed body; transient only
  bool unstable = false;       ///< failed because it blew up, not for want of steps
  bool rounded = false;        ///< failed for want of double precision
  std::string failure;         ///< empty when all went well
  std::optional<Fault> fault;  ///< where, when something went wrong at a place
};

}  // namespace brainshift::solve
