// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "discretise/interface/node_cloud.hpp"
#include "segmentation/geometry/points.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

class Visibility;

/// The nodes on the rim of a patch of prescribed displacement, and the places where their conditions are imposed
/// instead. Beyond its rim a surface follows the patch as a square root of the distance. Shape functions are smooth
/// there, so conditions at the rim's nodes carry the patch on by some 0.4 spacings; conditions `rim_inset` inside leave
/// it as wide as it is.
struct PatchRim {
  std::vector<std::int32_t> node;  ///< ascending
  Points places = Points(0, 3);    ///< mm
  ShapeRows extension;             ///< what is prescribed there, of what is prescribed at the nodes
  ShapeRows rows;                  ///< shape functions there; patch_rim() leaves them to who knows what the places see
};

/// In spacings. Measured: a disc on a slab and a cylinder then needs the force of finite elements, for linear MLS and
/// MMLS alike (verification, disc). Less where the patch is narrow, or its next node is near.
inline constexpr double rim_inset = 0.375;

/// Nodes of the surface with all components prescribed (n × 3, mm, NaN: free) such that in more than 140 degrees no
/// such node is near, but free ones are, with the surface going on smoothly. A patch that ends with its face, at an
/// edge, has none. fixed: nodes, ascending, whose conditions stay where they are and that belong to no patch. What is
/// prescribed is extended linearly from the nodes of the patch near by, so that a linear field stays exact. visibility:
/// of a cut or septum, past which a node sees none; nullptr: there is none.
PatchRim patch_rim(const NodeCloud& cloud, const Points& prescribed, std::span<const std::int32_t> fixed,
                   const Visibility* visibility = nullptr);

}  // namespace brainshift::solve
