// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "discretise/background_cells.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::solve {

/// Integration points in the order of their cells. All inside the body: the points of a cut cell are the centroids of
/// the inside parts of its octants, weighted with their volumes.
struct IntegrationPoints {
  Points positions;                  ///< undeformed, mm
  std::vector<double> volume;        ///< weight, mm³
  std::vector<std::int32_t> cell;    ///< background cell
  std::vector<std::int32_t> label;   ///< tissue
  std::size_t labelled_by_cell = 0;  ///< points that the label map gives no material, and that took their cell's label

  std::size_t size() const { return volume.size(); }
};

/// Gauss points of the background cells: points_per_cell 1 or 8 a hexahedron, 1 or 4 a tetrahedron. The tissue is read
/// from the label map at the point where there is a map and it names one of `tissues` there, else it is the cell's.
/// Throws std::invalid_argument when points_per_cell does not go with the kind of cell.
IntegrationPoints integration_points(const BackgroundCells& cells, int points_per_cell, const LabelMap* labels,
                                     const std::vector<std::int32_t>& tissues);

}  // namespace brainshift::solve
