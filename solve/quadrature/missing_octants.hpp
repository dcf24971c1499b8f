// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "discretise/interface/background_cells.hpp"
#include "discretise/interface/node_cloud.hpp"
#include "segmentation/geometry/surface.hpp"

namespace brainshift::solve {

/// The cells, with octants (quadrants) for the hexahedra (quadrilaterals) that lie inside the body in part, but do not
/// say with which: without them their points would be those of the whole cell, some of them outside the body. A cell
/// keeps the inside volume that its fraction says. What of it is inside is told
/// - in space by the body's closed surface, where it is known; hardly a part is at the surface's nearest place;
/// - in the plane by the outline() of the surface nodes, where it can be told,
/// - else by a plane that leaves the fraction inside. It faces as the cloud's surface does at the cell: away from the
///   nodes within two spacings about the surface node that is nearest.
/// Absent when nothing is missing, or neither is known. Throws std::invalid_argument unless the surface encloses a
/// body.
std::optional<BackgroundCells> with_missing_octants(const BackgroundCells& cells,
                                                    const std::optional<Surface>& boundary, const NodeCloud& cloud);

}  // namespace brainshift::solve
