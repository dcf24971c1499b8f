// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/geometry/points.hpp"

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
};

}  // namespace brainshift::solve
