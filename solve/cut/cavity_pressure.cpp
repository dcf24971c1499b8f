// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cavity_pressure.hpp"

#include <cmath>

namespace brainshift::solve {

Points cavity_force(const IntegrationPoints& points, std::span<const std::uint8_t> removed, const ShapeRows& rows,
                    Eigen::Index nodes, double pressure) {
  Points of_cavity = Points::Zero(nodes, 3), of_body = Points::Zero(nodes, 3);  // Σ w ∂φ/∂X, mm²
  Eigen::VectorXd seen_in_cavity = Eigen::VectorXd::Zero(nodes), seen = Eigen::VectorXd::Zero(nodes);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ShapeRow row = rows[i];
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::int32_t a = row.node[k];
      const double weight = points.volume[i] * std::abs(row.value[k]);
      const Eigen::RowVector3d area = points.volume[i] * row.gradient(k).transpose();
      seen[a] += weight;
      of_body.row(a) += area;
      if (removed[i] != 0) {
        seen_in_cavity[a] += weight;
        of_cavity.row(a) += area;
      }
    }
  }
  const Eigen::VectorXd share = seen_in_cavity.cwiseQuotient(seen.cwiseMax(1e-300));
  constexpr double newton = 1e-6;  // Pa mm² to N
  return newton * pressure * (of_cavity - share.asDiagonal() * of_body);
}

}  // namespace brainshift::solve
