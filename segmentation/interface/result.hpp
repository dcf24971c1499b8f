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

/// What became of the brain's labels on the way to one body.
struct BodyMeasures {
  double tissue_volume = 0;  ///< of the voxels that carry a brain label, mm³
  double volume = 0;         ///< of the body, mm³
  double loose_volume = 0;   ///< of tissue apart from the body, which was dropped, mm³
  std::size_t loose_pieces = 0;
};

struct Segmentation {
  std::optional<LabelMap> labels;        ///< as given or classified; absent when only a surface came in
  std::vector<ScalarImage> memberships;  ///< one a class, darkest first; empty unless classified
  Surface brain;                         ///< the union of the brain's tissues, holes filled, largest component
  Surface skull;  ///< inner surface of the skull, outward oriented like the others (the brain lies inside)
  std::map<std::uint16_t, Surface> tissues;         ///< one a brain label, where asked for
  std::map<std::string, SurfaceMeasures> measures;  ///< "brain", "skull", "tissue_<label>"
  std::optional<BodyMeasures> body;                 ///< absent when a surface came in
  std::optional<LabelMap> closed;                   ///< 1 where closing and filling took in what no label called brain
  std::vector<std::string> notes;                   ///< sentences for the user: what was dropped, filled or not reached
};

}  // namespace brainshift::segmentation
