// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "segmentation/image/image.hpp"
#include "segmentation/image/mask.hpp"
#include "segmentation/interface/options.hpp"

namespace brainshift::segmentation {

struct Classification {
  LabelMap labels;                       ///< parenchyma and ventricles inside the brain, 0 outside it
  std::vector<ScalarImage> memberships;  ///< one a class, darkest first; 0 outside the brain
};

/// Tells parenchyma from ventricles in a T1. The darkest of the fuzzy c-means classes is CSF; what of it hangs together
/// deep under the brain's surface is ventricle. CSF in the sulci stays parenchyma: the brain is the mask's body.
/// brain: the mask, one component, holes filled, on the T1's grid.
Classification classify(const ScalarImage& t1, const Mask& brain, const SegmentOptions& options);

}  // namespace brainshift::segmentation
