// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/nodal_displacement.hpp"

#include "solve/arrays/shared_work.hpp"

namespace brainshift::solve {

Points nodal_displacement(const ShapeRows& rows, const NodalVectors& parameters,
                          const std::vector<std::int32_t>& original) {
  Points displacement(static_cast<Eigen::Index>(rows.size()), 3);
  share_work(static_cast<std::int64_t>(rows.size()), nodes_a_part, [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    const ShapeRow row = rows[a];
    for (std::size_t k = 0; k < row.size(); ++k) {
      u += row.value[k] * Eigen::Map<const Eigen::Vector3d>(&parameters[4 * static_cast<std::size_t>(row.node[k])]);
    }
    displacement.row(original[a]) = u;
  });
  return displacement;
}

}  // namespace brainshift::solve
