// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "discretise/interface/background_cells.hpp"
#include "segmentation/image/image.hpp"
#include "solve/quadrature/integration_points.hpp"

namespace brainshift::solve {

/// Parts each integration point about which the label map has several tissues into one a tissue: cells know nothing of
/// where a tissue ends, and of a sheet thinner than their points lie apart they take whichever they hit. What is about
/// a point is told by samples spread evenly over its cell, those that are nearer to it than to the cell's other points;
/// they lie a voxel apart where that makes four to eight along the cell. A part has the point's volume by its share of
/// the samples. It lies where these have their middle, so that the centroid of all stays; of a cell that the surface
/// cuts it lies where the point was, which is inside. Less than a tenth is no part of its own, nor is what has none of
/// `tissues`.
/// points: those of a cell beside each other. full: of each point the volume that it would have were its cell not cut;
/// of a part its share of that. Uses all threads; the result does not depend on their number.
void part_by_tissue(const BackgroundCells& cells, const LabelMap& labels, const std::vector<std::int32_t>& tissues,
                    IntegrationPoints& points, std::vector<double>& full);

}  // namespace brainshift::solve
