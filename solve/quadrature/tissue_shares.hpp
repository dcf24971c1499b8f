// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "discretise/interface/background_cells.hpp"
#include "segmentation/image/image.hpp"
#include "solve/quadrature/integration_points.hpp"

namespace brainshift::solve {

/// Parts each integration point about which the label map has several tissues into one a tissue: cells know nothing of
/// where one tissue ends, and of a sheet thinner than their points lie apart they would take whichever they hit. What
/// is about a point is told by samples of its cell, no farther apart than voxels where that is an eighth of the cell or
/// more: those that are nearer to it than to the cell's other points. A part has the point's volume by its share of the
/// samples, and lies where they have their middle, so that the volume and the centroid of all stay. Labels that are
/// none of `tissues` do not count. points: those of a cell beside each other. full: of each point the volume that it
/// would have were its cell not cut; becomes that of the parts. Uses all threads; the result does not depend on their
/// number.
void part_by_tissue(const BackgroundCells& cells, const LabelMap& labels, const std::vector<std::int32_t>& tissues,
                    IntegrationPoints& points, std::vector<double>& full);

}  // namespace brainshift::solve
