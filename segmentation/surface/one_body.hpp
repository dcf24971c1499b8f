// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "segmentation/geometry/surface.hpp"

namespace brainshift::segmentation {

/// The largest body of a closed surface, with its cavities, and what else it held.
struct OneBody {
  Surface surface;
  double loose_volume = 0;  ///< of the other bodies, mm³
  std::size_t loose_pieces = 0;
};

/// surface: closed, 2-manifold, bodies outward and cavities inward. Throws std::invalid_argument where another body has
/// a fifth of the largest or more: which one is the brain is then not told.
OneBody one_body(const Surface& surface);

}  // namespace brainshift::segmentation
