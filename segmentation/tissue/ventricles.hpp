// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/image/mask.hpp"

namespace brainshift::segmentation {

/// The ventricles among the CSF. Sheets as thin as the sulci are opened away first; a body of what is left is ventricle
/// when most of it lies deeper under the brain's surface than ventricle_depth (mm): the cisterns and fissures are deep
/// too, but most of theirs reaches up to the surface. Bodies smaller than a twentieth of the largest are left out.
/// Empty when there is none. Both masks on one grid, csf within brain.
Mask find_ventricles(const Mask& csf, const Mask& brain, double ventricle_depth);

}  // namespace brainshift::segmentation
