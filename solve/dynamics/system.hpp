// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "solve/boundary/contact.hpp"
#include "solve/boundary/essential_conditions.hpp"
#include "solve/boundary/load_curve.hpp"
#include "solve/cut/face_contact.hpp"
#include "solve/dynamics/diagnosis.hpp"
#include "solve/dynamics/internal_force.hpp"
#include "solve/solve.hpp"

namespace brainshift::solve {

class Dissection;

/// What time stepping moves: points and laws that resist, conditions that hold, forces that push.
struct System {
  const PointBlocks& points;
  const PointLaws& laws;
  EssentialConditions& essential;
  Contact* contact;                           ///< null: nothing is stepped over
  const NodalVectors& external;               ///< forces on the parameters under the full load, µN; empty: none
  const LoadCurve& curve;                     ///< of the prescribed displacements and of the forces
  const ShapeRows& nodal_rows;                ///< at the nodes
  const std::vector<std::int32_t>& original;  ///< the cloud's node of each
  Dissection* dissection;                     ///< null: nothing is cut on the way
  FaceContact* face_contact = nullptr;        ///< of cuts; null: nothing is stepped over
  const NodalVectors* start = nullptr;        ///< û of a coarse solution under the full load; null: from rest
};

/// What time stepping leaves behind.
struct SteppingResult {
  NodalVectors parameters;          ///< û of the last good state, mm
  Points reactions = Points(0, 3);  ///< µN
  std::vector<HistoryRow> history;
  std::vector<Snapshot> snapshots;
  PointState state;
  HeldBytes held;  ///< of what stepping itself made: nodal vectors and viscosity
  int steps = 0;
  double fraction = 0;         ///< of the load, at the last good state
  double error_bound = 0;      ///< mm; relaxation only
  double critical_step = 0;    ///< s, of the undeformed body; transient only
  bool unstable = false;       ///< failed because it blew up, not for want of steps
  std::string failure;         ///< empty when all went well
  std::optional<Fault> fault;  ///< where, when something went wrong at a place
};

}  // namespace brainshift::solve
