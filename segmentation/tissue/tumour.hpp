// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "segmentation/image/mask.hpp"

namespace brainshift::segmentation {

/// Gives the voxels of a tumour mask the tumour's label (default_label::tumour), all of them or those of the body.
void add_tumour(LabelMap& labels, const LabelMap& tumour_mask);
void add_tumour(LabelMap& labels, const LabelMap& tumour_mask, const Mask& body);

/// A warning where a tenth of a tumour mask or more lies outside the brain's body, which loses it; else empty.
std::string outside_body(const LabelMap& tumour_mask, const Mask& body);

}  // namespace brainshift::segmentation
