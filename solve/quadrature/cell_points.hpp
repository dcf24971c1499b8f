// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "discretise/interface/background_cells.hpp"
#include "segmentation/image/image.hpp"
#include "solve/quadrature/integration_points.hpp"

namespace brainshift::solve {

/// The most integration points that a cell of this kind takes: 8 a hexahedron, 4 a tetrahedron or quadrilateral, 3 a
/// triangle. They integrate quadratics exactly; the other number that each takes is 1.
int most_points_per_cell(CellKind kind);

/// As asked, else the most, or 1 where integration is adaptive.
int points_per_cell(std::optional<int> asked, CellKind kind, bool adaptive);

/// Throws std::invalid_argument when cells of this kind do not take so many points.
void check_points_per_cell(CellKind kind, int points);

/// The tissue of each point, from the label map at the point where there is a map and it names one of `tissues` there,
/// else from its cell.
void take_tissues(const BackgroundCells& cells, const LabelMap* labels, const std::vector<std::int32_t>& tissues,
                  IntegrationPoints& points);

/// Gauss points of the background cells, points_per_cell 1 or most_points_per_cell(), with the tissues of
/// take_tissues(), parted where the label map has several (part_by_tissue()). Throws std::invalid_argument when
/// points_per_cell does not go with the kind of cell.
IntegrationPoints integration_points(const BackgroundCells& cells, int points_per_cell, const LabelMap* labels,
                                     const std::vector<std::int32_t>& tissues);

}  // namespace brainshift::solve
