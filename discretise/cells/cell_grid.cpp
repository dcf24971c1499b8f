// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cells/cell_grid.hpp"

#include <Eigen/LU>

namespace brainshift::discretise {

double inside_volume(const BackgroundCells& cells) {
  const auto corners = static_cast<std::size_t>(cells.corners());
  double total = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const std::int32_t* const corner = cells.connectivity.data() + cell * corners;
    const bool hexahedron = cells.kind == CellKind::hexahedron;
    const int along[3] = {1, hexahedron ? 3 : 2, hexahedron ? 4 : 3};
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) {
      edges.row(k) = cells.vertices.row(corner[along[k]]) - cells.vertices.row(corner[0]);
    }
    total += cells.inside_fraction[cell] * edges.determinant() / (hexahedron ? 1 : 6);
  }
  return total;
}

}  // namespace brainshift::discretise
