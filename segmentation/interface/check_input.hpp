// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/interface/input.hpp"
#include "segmentation/interface/options.hpp"

namespace brainshift::segmentation {

/// Throws std::invalid_argument, with a sentence, when the parts of the input do not fit together or an option is out
/// of range.
void check_input(const SegmentInput& input, const SegmentOptions& options);

}  // namespace brainshift::segmentation
