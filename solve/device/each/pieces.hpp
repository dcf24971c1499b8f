// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/device/clusters.hpp"
#include "solve/device/each/view.hpp"

namespace brainshift::solve::device {

/// Clusters<Scalar> as a device reads them for many members, who have no room in the memory of a block: pairs with the
/// numbers of nodes and points over the whole body, patches in pieces, slots in shares.
template <class Scalar>
struct Pieces {
  Clusters<Scalar> of;  ///< pairs as said above
  std::vector<Piece> pieces;
  std::vector<PatchOfPieces> patches;
  std::vector<std::int32_t> share_begin;
  std::vector<double> touch_reach;  ///< Σ w |B| of each touch
};

/// blocks: of the team; pieces are as small as that each of its groups has at most one, if it can be.
template <class Scalar>
Pieces<Scalar> make_pieces(const PointBlocks& points, int blocks);

}  // namespace brainshift::solve::device
