// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::test {

struct Domain {
  std::string name;
  NodeCloud cloud;
  BackgroundCells cells;
};

/// Cells about as large as the spacing of the nodes.
inline std::vector<Domain> domains(double side) {
  const NodeCloud box = irregular_box(4, side), rectangle = irregular_rectangle(13, 13, side, side);
  return {{"hexahedra", box, box_cells(4, side)},
          {"tetrahedra", box, box_tetrahedra(irregular_box(4, side), 4)},
          {"quadrilaterals", rectangle, rectangle_cells(7, 7, side, side)},
          {"triangles", rectangle, rectangle_triangles(irregular_rectangle(7, 7, side, side), 7, 7)}};
}

}  // namespace brainshift::test
