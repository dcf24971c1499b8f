// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/surface/surface_measures.hpp"

namespace brainshift::segmentation {

/// Makes a surface from outside fit for the other stages: its holes of at most eight times edge_length (mm) and a
/// quarter of its extent are closed; it is turned outward where it is then closed and free of self-intersection, else
/// wrapped (counted as repaired); and it is remeshed to edge_length. Of several bodies the largest is taken. Throws
/// std::invalid_argument when nothing closed comes out, the wrap fills or loses most of it, or another body has a fifth
/// of the largest or more.
struct CheckedSurface {
  Surface surface;
  SurfaceMeasures measures;
  double loose_volume = 0;  ///< of bodies apart from the largest, which were dropped, mm³
  std::size_t loose_pieces = 0;
  std::size_t closed_holes = 0;  ///< none where it was wrapped
};
CheckedSurface checked_surface(const Surface& surface, double edge_length);

}  // namespace brainshift::segmentation
