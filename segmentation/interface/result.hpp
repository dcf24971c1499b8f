// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"
#include "segmentation/surface/surface_measures.hpp"

namespace brainshift::segmentation {

struct Segmentation {
  std::optional<LabelMap> labels;        ///< as given or classified; absent when only a surface came in
  std::vector<ScalarImage> memberships;  ///< one a class, darkest first; empty unless classified
  Surface brain;                         ///< the union of the brain's tissues, holes filled, largest component
  Surface skull;  ///< inner surface of the skull, outward oriented like the others (the brain lies inside)
  std::map<std::int16_t, Surface> tissues;          ///< one a brain label
  std::map<std::string, SurfaceMeasures> measures;  ///< "brain", "skull", "tissue_<label>"
};

}  // namespace brainshift::segmentation
