// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "segmentation/image/image.hpp"

namespace brainshift::registration {

struct InvertedField {
  VectorImage field;             ///< at y the displacement d with x = y + d and x + forward(x) = y, mm
  std::size_t not_inverted = 0;  ///< voxels where |x + forward(x) - y| stayed above the tolerance
};

/// Inverts the trilinear map x + forward(x) on its own grid, by Newton's method at each voxel. Beyond the image the
/// field is held constant, so that what comes in from outside is known to. Where the map folds, the best place found is
/// taken and counted.
InvertedField resampling_field(const VectorImage& forward, double tolerance);

}  // namespace brainshift::registration
