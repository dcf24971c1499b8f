// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "solve/boundary/contact.hpp"
#include "solve/cut/cut_body.hpp"
#include "solve/cut/face_contact.hpp"
#include "solve/dynamics/diagnosis.hpp"
#include "solve/dynamics/system.hpp"
#include "solve/pieces.hpp"
#include "solve/solve.hpp"

namespace brainshift::solve {

/// A model as stepping needs it; what was only needed to make it is gone. Nodes are along a space-filling curve.
struct Prepared {
  std::vector<std::int32_t> original;  ///< the cloud's node of each
  ShapeRows nodal_rows;                ///< at the nodes' own positions, without derivatives
  PointBlocks points;
  PlacedPoints placed;  ///< for the sentence about a failure
  PointLaws laws;
  std::vector<std::vector<PronyTerm>> prony;  ///< of a transient run: one list a row of the laws, or none
  std::vector<double> mass;                   ///< of a transient run: physical, g
  EssentialConditions essential;
  std::optional<Contact> contact;
  std::optional<FaceContact> face_contact;
  NodalVectors external;
  NodalVectors start;            ///< û to relax from; empty: from rest
  std::optional<CutBody> cut;    ///< absent: a scene without one
  std::optional<Pieces> pieces;  ///< where cuts go on; else they are gone
};

/// pinned: one a node of the cloud, not 0 where the prescribed displacement is that of the node's parameter û (and the
/// node's row of shape functions 1 at itself); empty: none. Such a node is held, not loaded. Sets the sizes among the
/// measures. Of a model with a resection this is what it leaves, resect(). Throws as solve() does.
Prepared prepare(const Model& model, const SolveOptions& options, std::span<const std::uint8_t> pinned,
                 SolveMeasures& measures, const Progress& progress);

/// Steps what was prepared to the end, and fills in the rest of the measures.
SolveResult step(const Model& model, const SolveOptions& options, Prepared prepared, SolveMeasures measures,
                 const Progress& progress);

/// The options with what the model says of them.
SolveOptions completed(SolveOptions options, const Model& model);

}  // namespace brainshift::solve
