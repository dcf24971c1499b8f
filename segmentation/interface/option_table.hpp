// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/interface/options.hpp"
#include "segmentation/options/option.hpp"

namespace brainshift::segmentation {

/// Name, range, unit and help of each option.
const OptionTable<SegmentOptions>& segment_options();

/// Throws std::invalid_argument with a sentence on a value that the table does not allow.
void check_options(const SegmentOptions& options);

}  // namespace brainshift::segmentation
