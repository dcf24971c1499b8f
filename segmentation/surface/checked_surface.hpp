// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/surface/surface_measures.hpp"

namespace brainshift::segmentation {

/// Makes a surface from outside fit for the other stages: turned outward where it is closed and free of
/// self-intersection, else wrapped (counted as repaired), then remeshed to edge_length (mm). Of several bodies the
/// largest is taken. Throws std::invalid_argument when nothing closed comes out, the wrap fills or loses most of it, or
/// another body has a fifth of the largest or more.
struct CheckedSurface {
  Surface surface;
  SurfaceMeasures measures;
  double loose_volume = 0;  ///< of bodies apart from the largest, which were dropped, mm³
  std::size_t loose_pieces = 0;
};
CheckedSurface checked_surface(const Surface& surface, double edge_length);

}  // namespace brainshift::segmentation
