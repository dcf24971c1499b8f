// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

/// The nodes on the rim of a patch of prescribed displacement, and where their conditions are imposed instead. Beyond
/// its rim a surface follows the patch as a square root of the distance. Shape functions are smooth there, so
/// conditions at the rim's nodes carry the patch on by `rim_inset` of a spacing; conditions that far inside leave it as
/// wide as it is.
struct PatchRim {
  std::vector<std::int32_t> node;    ///< ascending
  Points prescribed = Points(0, 3);  ///< where the condition is imposed, mm
  ShapeRows rows;                    ///< there
};

/// In spacings. Measured: for linear MLS and MMLS alike a disc on a slab and a cylinder then needs the force of finite
/// elements (verification, disc).
inline constexpr double rim_inset = 0.375;

/// Nodes of the surface with all components prescribed (n × 3, mm, NaN: free) such that in more than 140 degrees no
/// such node is near, but free ones are, with the surface going on smoothly. A patch that ends with its face, at an
/// edge, has none. fixed: nodes, ascending, whose conditions stay where they are. What is prescribed is extended
/// linearly from the nodes of the patch near by, so that a linear field stays exact.
PatchRim patch_rim(const Points& positions, std::span<const double> spacing, std::span<const std::uint8_t> on_surface,
                   const Points& prescribed, std::span<const std::int32_t> fixed, const ShapeFunctions& shape);

/// The rows of all nodes with those of the rim in their place.
ShapeRows rows_of_conditions(const ShapeRows& nodal_rows, const PatchRim& rim);

/// What is prescribed at all nodes, at the rim's where its conditions are.
Points prescribed_of_conditions(const Points& prescribed, const PatchRim& rim);

}  // namespace brainshift::solve
