// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/image/image.hpp"

namespace brainshift {

/// A mask, and what the user should know of it.
struct ReadMask {
  LabelMap map;
  std::string warning;  ///< empty where there is nothing to say
};

/// As read_mask(). Of a T1 that a spline resampled, which has rings outside the brain, the mask is 1 where the T1 is
/// clearly above 0 or enclosed by what is, and the warning says so.
ReadMask read_mask_and_warning(const std::filesystem::path& file);

}  // namespace brainshift
