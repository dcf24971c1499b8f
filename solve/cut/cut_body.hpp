// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solve/cut/cut_facets.hpp"
#include "solve/cut/face_nodes.hpp"
#include "solve/interface/model.hpp"

namespace brainshift::solve {

/// A body with its cuts as far as they have come.
struct CutBody {
  InsideBody inside;
  NodeCloud cloud;              ///< the model's nodes, those on the cut split, then the added ones
  Conditions conditions;        ///< at them
  std::vector<FacePair> pairs;  ///< of the septum, then of the cuts
  std::size_t septum_pairs = 0;
  CutFacets septum = {};                         ///< none: empty
  std::size_t split = 0;                         ///< nodes of the model that were split
  std::shared_ptr<const Visibility> visibility;  ///< null: nothing is cut yet

  /// Of the septum and the cuts.
  CutFacets facets() const { return visibility ? visibility->facets() : CutFacets(); }
  std::span<const FacePair> cut_pairs() const { return std::span(pairs).subspan(septum_pairs); }
};

/// The model's body, parted by its septum and cut as at the start. Throws std::invalid_argument where a cut does not go
/// with the model: a path in space or a sheet in the plane, one that does not meet the body, one that goes on after the
/// load's curve has ended; and where the septum is at fault (check_septum()), lies in a plane problem or does not meet
/// the body.
CutBody cut_body(const Model& model);

/// Takes a body's cuts to these facets, which go on where the last ones ended; the septum stays.
void cut_further(CutFacets facets, CutBody& body);

}  // namespace brainshift::solve
