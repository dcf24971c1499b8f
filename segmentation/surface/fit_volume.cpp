// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "segmentation/surface/extract.hpp"

namespace brainshift::segmentation {
void fit_volume(Surface& surface, double wanted) {
  constexpr int most_rounds = 50;
  for (int round = 0; round < most_rounds; ++round) {
    const double missing = wanted - volume(surface);
    if (std::abs(missing) <= 1e-4 * wanted) {
      return;
    }
    surface.vertices += missing / area(surface) * vertex_normals(surface).rowwise().normalized();
  }
}

}  // namespace brainshift::segmentation
