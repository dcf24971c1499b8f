// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/boundary/patch_rim.hpp"
#include "solve/interface/shape_options.hpp"
#include "solve/shape/shape_rows.hpp"
#include "solve/shape/visibility.hpp"

namespace brainshift::solve {

/// µ of the tissue that each node moves with, Pa: of the stiffest that, with all that is stiffer, has a fifth of
/// Σ_I w φ_a², I the integration points. Infinite where no point sees the node. A node on the boundary of two tissues
/// moves with the stiffer one, one in soft tissue half a spacing off it with its own. rows: at the points. volume;
/// modulus, µ in Pa: one a point.
std::vector<double> moduli_at_nodes(std::span<const double> volume, std::span<const double> modulus,
                                    const ShapeRows& rows, std::size_t nodes);

/// The cloud whose shape functions are changed, its cut, and what its nodes move with.
struct MixedCloud {
  const Points& positions;
  std::span<const double> spacing;
  const ShapeOptions& options;
  std::shared_ptr<const Visibility> visibility;
  std::span<const double> modulus;  ///< moduli_at_nodes(), Pa; none: all see each other
};

/// Hides nodes of soft tissue from places in tissue that is much stiffer (much_stiffer()): the rows of these places
/// become shape functions of the nodes that are left. Of a node of soft tissue stiff tissue sees a scrap of the shape
/// function alone, which then moves it by what is wrong with the stiff tissue's strain, and the soft one hardly
/// resists. Supports grow to at most 1.7 times their radii for it. Where the nodes that are left are then still too few
/// or lie in one plane, as in a flat layer thinner than a spacing, the place sees all as before. modulus: µ at the
/// places, Pa. rows: at the places, with derivatives or without. Returns how many rows changed. After the visibility
/// criterion for discontinuities of the material (Cordes & Moran 1996), one way.
std::size_t hide_soft_nodes(const MixedCloud& cloud, const Points& places, std::span<const double> modulus,
                            ShapeRows& rows);

/// The shape functions at the places of a rim, each hiding what its node's tissue does not see.
ShapeRows rows_at_rim(const MixedCloud& cloud, const PatchRim& rim);

}  // namespace brainshift::solve
