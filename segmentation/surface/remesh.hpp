// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "segmentation/geometry/surface.hpp"

namespace brainshift::segmentation {

/// The same surface with triangles of one edge length (mm), vertices on the old surface (Botsch & Kobbelt 2004, by
/// CGAL). Turned outward when it is closed. Where the input is not 2-manifold, vertices are doubled first.
Surface remeshed(const Surface& surface, double edge_length);

/// The same surface with each hole closed by triangles between the vertices of its border (Liepa 2003, by CGAL) that is
/// at most `widest` across (mm, the longest side of its box). Where the input is not 2-manifold, vertices are doubled
/// first.
struct ClosedHoles {
  Surface surface;
  std::size_t count = 0;
};
ClosedHoles with_holes_closed(const Surface& surface, double widest);

/// A closed, 2-manifold surface free of self-intersection around whatever came in: holes narrower than `opening` (mm)
/// are bridged (alpha wrap, Portaneri et al. 2022, by CGAL). It lies outside the input by about a thirtieth of
/// `opening`.
Surface wrapped(const Surface& surface, double opening);

}  // namespace brainshift::segmentation
