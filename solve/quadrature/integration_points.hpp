// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "discretise/background_cells.hpp"
#include "segmentation/image/image.hpp"
#include "solve/held_bytes.hpp"

namespace brainshift::solve {

/// Integration points in the order of their cells. All inside the body: the points of a cut cell are the centroids of
/// the inside parts of its octants, weighted with their volumes, slivers merged (merge_slivers()). Planar cells count
/// as 1 mm thick: the forces of a planar problem are those on 1 mm of thickness.
struct IntegrationPoints {
  Points positions;                  ///< undeformed, mm
  std::vector<double> volume;        ///< weight, mm³; of planar cells area × 1 mm
  std::vector<std::int32_t> cell;    ///< background cell
  std::vector<std::int32_t> label;   ///< tissue
  std::size_t labelled_by_cell = 0;  ///< points that the label map gives no material, and that took their cell's label

  std::size_t size() const { return volume.size(); }
  std::size_t held_bytes() const {
    return static_cast<std::size_t>(positions.size()) * sizeof(double) + bytes(volume) + bytes(cell) + bytes(label);
  }
};

/// The most integration points that a cell of this kind takes: 8 a hexahedron, 4 a tetrahedron or quadrilateral, 3 a
/// triangle. They integrate quadratics exactly; the other number that each takes is 1.
int most_points_per_cell(CellKind kind);

/// Throws std::invalid_argument when cells of this kind do not take so many points.
void check_points_per_cell(CellKind kind, int points);

/// The tissue of each point, from the label map at the point where there is a map and it names one of `tissues` there,
/// else from its cell.
void take_tissues(const BackgroundCells& cells, const LabelMap* labels, const std::vector<std::int32_t>& tissues,
                  IntegrationPoints& points);

/// Gauss points of the background cells, points_per_cell 1 or most_points_per_cell(), with the tissues of
/// take_tissues(). Throws std::invalid_argument when points_per_cell does not go with the kind of cell.
IntegrationPoints integration_points(const BackgroundCells& cells, int points_per_cell, const LabelMap* labels,
                                     const std::vector<std::int32_t>& tissues);

}  // namespace brainshift::solve
