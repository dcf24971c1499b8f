// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "discretise/interface/options.hpp"
#include "discretise/interface/result.hpp"
#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"
#include "segmentation/progress/progress.hpp"

namespace brainshift::discretise {

/// Fills a closed surface with nodes and background cells. The same input and seed give the same result bit for bit.
/// labels may be null: everything is tissue 1. The label of a node or cell is that of the nearest brain voxel when the
/// voxel it lies in is not of the brain. Throws std::invalid_argument on a surface that is open, self-intersecting or
/// inside out (the brain's, or that of what a resection takes out), options out of range, a spacing too coarse or too
/// fine for the body, and labels that do not lie where the surface does.
Discretisation discretise(const Surface& brain, const LabelMap* labels, const DiscretiseOptions& options,
                          const Progress& progress = {});

/// Writes nodes.vtu and cells.vtu into a folder that exists. Throws std::runtime_error, naming the file, when one
/// cannot be written whole.
void write_discretisation(const std::filesystem::path& folder, const Discretisation& discretisation);

}  // namespace brainshift::discretise
