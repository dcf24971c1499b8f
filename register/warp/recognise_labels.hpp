// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// Whether an image is a label map: whole numbers from 0 on, few of them different, which lie in patches where there
/// are more than a mask has. An 8-bit MRI has few values, too, but neighbours that differ, and a CT has negative ones.
/// A map with -1 for background and more in patches than 0 and 1 counts as one, so that it is refused and not
/// interpolated.
bool looks_like_labels(const ScalarImage& image);

}  // namespace brainshift::registration
