// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// Of the voxels of a grid that move, by more than a tenth of a millimetre, the share that an image is resampled at
/// outside of its voxels for; NaN where none moves. At most a million voxels are looked at.
double share_from_outside(const ImageGeometry& image, const VectorImage& resampling, const ImageGeometry& grid);

}  // namespace brainshift::registration
