// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"
#include "solve/interface/solution.hpp"

namespace brainshift::registration {

struct RegisterInput {
  Solution solution;
  Surface brain;                   ///< preop brain surface, closed, outward: outside it the field fades
  ScalarImage t1;                  ///< its grid is the fields'; without voxels there is no image to warp, only the grid
  std::optional<LabelMap> labels;  ///< on the T1's grid
  Points landmarks = Points(0, 3);  ///< preop, mm LPS
};

}  // namespace brainshift::registration
