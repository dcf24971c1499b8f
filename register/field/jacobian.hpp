// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// det(I + ∂u/∂x) of a forward field at its voxels, derivatives in the world (an oblique or left-handed grid gives the
/// same), by central differences, one-sided on the image's border. ITK's filter for it leaves out the image's
/// direction.
ScalarImage jacobian(const VectorImage& forward);

}  // namespace brainshift::registration
