// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/nodal_displacement.hpp"

#include "solve/arrays/shared_work.hpp"

namespace brainshift::solve {

NodalVectors displacement_of(const ShapeRows& rows, const NodalVectors& parameters) {
  NodalVectors displacement(4 * rows.size());
  share_work(static_cast<std::int64_t>(rows.size()), nodes_a_part, [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    Eigen::Vector4d u = Eigen::Vector4d::Zero();
    const ShapeRow row = rows[a];
    for (std::size_t k = 0; k < row.size(); ++k) {
      u += row.value[k] * at(parameters, static_cast<std::size_t>(row.node[k]));
    }
    at(displacement, a) = u;
  });
  return displacement;
}

Points values_of(const ShapeRows& rows, const Points& nodal) {
  Points values(static_cast<Eigen::Index>(rows.size()), 3);
  share_work(values.rows(), nodes_a_part, [&](std::int64_t i) {
    const ShapeRow row = rows[static_cast<std::size_t>(i)];
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (std::size_t k = 0; k < row.size(); ++k) {
      sum += row.value[k] * nodal.row(row.node[k]);
    }
    values.row(i) = sum;
  });
  return values;
}

Points nodal_displacement(const ShapeRows& rows, const NodalVectors& parameters,
                          const std::vector<std::int32_t>& original) {
  const NodalVectors ordered = displacement_of(rows, parameters);
  Points displacement(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t a = 0; a < rows.size(); ++a) {
    displacement.row(original[a]) = at(ordered, a).head<3>();
  }
  return displacement;
}

}  // namespace brainshift::solve
