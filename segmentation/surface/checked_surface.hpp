// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/surface/surface_measures.hpp"

namespace brainshift::segmentation {

/// Makes a surface from outside fit for the other stages: turned outward where it is closed and free of
/// self-intersection, else wrapped (counted as repaired), then remeshed to edge_length (mm).
/// Throws std::invalid_argument when nothing closed comes out, or the wrap fills or loses most of it.
struct CheckedSurface {
  Surface surface;
  SurfaceMeasures measures;
};
CheckedSurface checked_surface(const Surface& surface, double edge_length);

}  // namespace brainshift::segmentation
