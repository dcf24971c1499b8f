// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/nodal_displacement.hpp"

namespace brainshift::solve {

Points nodal_displacement(const ShapeRows& rows, const NodalVectors& parameters,
                          const std::vector<std::int32_t>& original) {
  Points displacement(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t a = 0; a < rows.size(); ++a) {
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    const ShapeRow row = rows[a];
    for (std::size_t k = 0; k < row.size(); ++k) {
      u += row.value[k] * Eigen::Map<const Eigen::Vector3d>(&parameters[4 * static_cast<std::size_t>(row.node[k])]);
    }
    displacement.row(original[a]) = u;
  }
  return displacement;
}

}  // namespace brainshift::solve
