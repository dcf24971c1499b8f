// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/interface/cut.hpp"
#include "solve/interface/shape_options.hpp"

namespace brainshift {

/// What leaves the solve stage: the displacement at the nodes, u = Σφû, never the parameters û.
struct Solution {
  Points positions;             ///< undeformed nodes, mm, LPS, in the cloud's order
  Points displacement;          ///< mm
  Points reaction_force;        ///< N; zero at nodes where nothing is prescribed
  std::vector<double> spacing;  ///< of the cloud, mm: with the shape options it gives back the shape functions
  ShapeOptions shape;           ///< the shape functions it was computed with
  solve::CutFacets cut = {};    ///< that parts the body; none: empty
  std::vector<double> estimated_error = {};  ///< of the displacement at each node, mm; empty where there is no estimate
};

}  // namespace brainshift
