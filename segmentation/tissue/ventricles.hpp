// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/image/mask.hpp"

namespace brainshift::segmentation {

/// Share of the brain's volume below which the ventricles were hardly found: 6 ml of 1500, where adults have 10 to 60.
inline constexpr double few_ventricles = 0.004;

/// The ventricles among the CSF. Sheets as thin as the sulci are opened away first; a body of what is left is ventricle
/// when most of it lies deeper under the brain's surface than ventricle_depth (mm): the cisterns and fissures are deep
/// too, but most of theirs reaches up to the surface. Left out are bodies smaller than a twentieth of the largest or
/// than 0.02 % of the brain. Where less than 0.8 % of the brain is found so, ventricles hang on a cistern, as they do
/// in thick slices: sheets up to three times as thick are opened away, and what then comes loose is added.
/// Empty when there is none. Both masks on one grid, csf within brain.
Mask find_ventricles(const Mask& csf, const Mask& brain, double ventricle_depth);

}  // namespace brainshift::segmentation
