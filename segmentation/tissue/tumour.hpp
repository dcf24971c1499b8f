// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "segmentation/image/mask.hpp"

namespace brainshift::segmentation {

/// The part of a tumour mask that lies in the brain's body.
Mask in_body(const LabelMap& tumour_mask, const Mask& body);

/// Gives the tumour's voxels its label (default_label::tumour).
void add_tumour(LabelMap& labels, const Mask& tumour);

/// A warning where a tenth of a tumour mask or more lies outside the brain's body, which loses it; else empty.
std::string outside_body(const LabelMap& tumour_mask, const Mask& body);

}  // namespace brainshift::segmentation
