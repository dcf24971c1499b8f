// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "segmentation/image/image.hpp"
#include "segmentation/surface/extract.hpp"

namespace brainshift::segmentation {

/// The surface of the tissue that a resection takes out: closed, outward from it. Outside the brain the tissues go on
/// for a few millimetres, each voxel as the nearest of the brain, so that where the tissue lies at the brain's surface
/// the wall crosses that and does not run beside it. brain: the labels of the brain's tissues; taken: some of them.
/// Throws std::invalid_argument when no voxel carries a label that is taken, or extract_surface() does.
MeasuredSurface resection_wall(const LabelMap& labels, std::span<const std::uint16_t> brain,
                               std::span<const std::uint16_t> taken, double edge_length);

}  // namespace brainshift::segmentation
