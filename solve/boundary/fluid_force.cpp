// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/fluid_force.hpp"

#include <algorithm>

namespace brainshift::solve {

namespace {

constexpr double in_micronewton = 1e-3;  // kg/m³ m/s² to µN/mm³

/// Where a point stands to the level: its share above, and the mean over it of max(0, h), mm. Taken for a box with an
/// edge along gravity.
struct Above {
  double share, height;

  Above(double height_of_middle, double edge) {
    const double top = height_of_middle + edge / 2;
    share = top >= edge ? 1 : top <= 0 ? 0 : top / edge;
    height = share < 1 ? share * std::max(0.0, top) / 2 : height_of_middle;
  }
};

}  // namespace

double highest(const Eigen::Vector3d& gravity, const Points& points) {
  return (points * gravity.normalized()).minCoeff();
}

double drained_level(const Eigen::Vector3d& gravity, double share, const Points& points) {
  const Eigen::VectorXd along = points * gravity.normalized();
  return along.minCoeff() + share * (along.maxCoeff() - along.minCoeff());
}

void add_fluid_force(const DrainedFluid& fluid, const std::map<std::int32_t, Material>& materials,
                     const IntegrationPoints& points, const PointExtents& extents, const ShapeRows& rows,
                     NodalVectors& total) {
  const Eigen::Vector3d fluid_weight = in_micronewton * fluid.density * fluid.gravity;
  const Eigen::Vector3d turned = fluid.gravity - fluid.gravity_of_image;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Material& material = materials.at(points.label[i]);
    if (material.room == Room::drained) {
      continue;
    }
    const Above above(fluid.level - extents.middle[i], extents.edge[i]);
    Eigen::Vector3d force = above.share * fluid_weight;
    double suction = 0;  // µN/mm²
    if (material.room == Room::full) {
      suction = fluid_weight.norm() * above.height;
    } else {
      force += in_micronewton * (material.density - fluid.density) * turned;
    }
    const ShapeRow shape = rows[i];
    for (std::size_t k = 0; k < shape.size(); ++k) {
      at(total, static_cast<std::size_t>(shape.node[k])).head<3>() +=
          points.volume[i] * (shape.value[k] * force - suction * shape.gradient(k));
    }
  }
}

}  // namespace brainshift::solve
