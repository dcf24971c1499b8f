// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/external_force.hpp"

namespace brainshift::solve {

namespace {

constexpr double micronewton = 1e6;  // N to µN

void spread(const Eigen::Vector3d& force, const ShapeRows& rows, std::size_t row, NodalVectors& total) {
  const ShapeRow shape = rows[row];
  for (std::size_t k = 0; k < shape.size(); ++k) {
    at(total, static_cast<std::size_t>(shape.node[k])).head<3>() += micronewton * shape.value[k] * force;
  }
}

}  // namespace

void add_nodal_force(const Points& force, const ShapeRows& nodal_rows, NodalVectors& total) {
  for (std::size_t a = 0; a < nodal_rows.size(); ++a) {
    spread(force.row(static_cast<Eigen::Index>(a)).transpose(), nodal_rows, a, total);
  }
}

void add_body_force(const BodyForce& body_force, const IntegrationPoints& points, const ShapeRows& rows,
                    NodalVectors& total) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d position = points.positions.row(static_cast<Eigen::Index>(i));
    spread(points.volume[i] * body_force(position, points.label[i]), rows, i, total);
  }
}

}  // namespace brainshift::solve
