// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// Gives voxels of a field the harmonic displacement, Δu = 0, between those around them, where nothing is that moves: a
/// uniform shrinking or a rigid motion of the wall goes on inside as it is. hollow: their offsets, ascending; moves:
/// which other voxels hold a displacement; across the rest nothing is prescribed. To 1e-4 of the residual.
void span_cavity(std::span<const std::size_t> hollow, const std::function<bool(std::size_t voxel)>& moves,
                 VectorImage& field);

}  // namespace brainshift::registration
