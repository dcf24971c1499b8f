// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// Whether an image is a label map: whole numbers from -1 on, few of them different, and, where there are more than a
/// mask has, neighbours that mostly are the same outside the background. An 8-bit MRI has few values, too, but
/// neighbours that differ, and a CT has more negative ones.
bool looks_like_labels(const ScalarImage& image);

}  // namespace brainshift::registration
