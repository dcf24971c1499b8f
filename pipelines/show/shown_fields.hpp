// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

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

/// Writes values at the solution's nodes as an image of the intraop brain, on voxels of 4 mm, 0 outside. Throws
/// std::runtime_error, naming the file, when it cannot be written whole.
void write_nodal_image(const std::filesystem::path& file, const Solution& solution, const std::vector<double>& values);

}  // namespace brainshift::pipelines
