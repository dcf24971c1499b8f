// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"
#include "solve/interface/solution.hpp"

namespace brainshift::pipelines {

/// What viewers colour. brain_intraop.vtp: the brain's surface as it lies intraop, with the point arrays displacement
/// (LPS), displacement_mm, its length, and, where the solution has an estimate, estimated_error_mm.
/// estimated_error.nii.gz: the same estimate intraop, on voxels of 4 mm, 0 outside the brain. Throws
/// std::runtime_error, naming the file, when one cannot be written whole.
void write_shown_fields(const std::filesystem::path& folder, const Solution& solution, const Surface& brain,
                        const VectorImage& forward);

/// The solution's estimated error at points of the preop or, with `moved`, the intraop brain: weights 1 / distance²
/// over the eight nearest nodes. 0 at a point farther than the spacing from every node.
std::vector<double> estimated_error_at(const Solution& solution, bool moved, const Points& points);

/// The same at the voxels of a grid.
ScalarImage estimated_error_on(const Solution& solution, bool moved, const ImageGeometry& grid);

}  // namespace brainshift::pipelines
