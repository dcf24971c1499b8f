// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"
#include "solve/interface/solution.hpp"

namespace brainshift::registration {

/// What a resection has taken out.
struct Cavity {
  Surface wall;                      ///< preop, closed, outward from what went, mm; it may reach out of the brain
  std::vector<std::int32_t> labels;  ///< that it had
};

struct RegisterInput {
  Solution solution;
  Surface brain;                   ///< preop brain surface, closed, outward: outside it the field fades
  ScalarImage t1;                  ///< its grid is the fields'; without voxels there is no image to warp, only the grid
  std::optional<LabelMap> labels;  ///< on the T1's grid
  Points landmarks = Points(0, 3);    ///< preop, mm LPS
  std::optional<Cavity> cavity = {};  ///< absent: nothing is taken out
};

}  // namespace brainshift::registration
