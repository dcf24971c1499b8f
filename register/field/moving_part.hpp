// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// A displacement field cut to the voxels that move and one around them, at least two along each axis. A transform is
/// the identity outside its grid, and the part ends in zeros; it ends at the image's border where that moves.
VectorImage moving_part(const VectorImage& field);

}  // namespace brainshift::registration
