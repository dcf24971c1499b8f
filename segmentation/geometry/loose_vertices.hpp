// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/geometry/surface.hpp"

namespace brainshift {

/// Without the vertices of no triangle; the others in their order.
Surface without_loose_vertices(const Surface& surface);

}  // namespace brainshift
