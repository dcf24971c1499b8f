// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "solve/cut/cut_facets.hpp"
#include "solve/cut/face_nodes.hpp"
#include "solve/interface/model.hpp"

namespace brainshift::solve {

/// A body with its cuts as far as they have come.
struct CutBody {
  InsideBody inside;
  NodeCloud cloud;        ///< the model's nodes, those on the cut split, then the added ones
  Conditions conditions;  ///< at them
  std::vector<FacePair> pairs;
  std::size_t split = 0;                         ///< nodes of the model that were split
  std::shared_ptr<const Visibility> visibility;  ///< null: nothing is cut yet

  CutFacets facets() const { return visibility ? visibility->facets() : CutFacets(); }
};

/// The model's body, cut as at the start. Throws std::invalid_argument where a cut does not go with the model: a path
/// in space or a sheet in the plane, one that does not meet the body,
/// one that goes on after the load's curve has ended.
CutBody cut_body(const Model& model);

/// Of a cloud's nodes, mm.
double mean_spacing(const NodeCloud& cloud);

/// Takes a body's cuts to these facets, which go on where the last ones ended.
void cut_further(CutFacets facets, CutBody& body);

}  // namespace brainshift::solve
