// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/fluid_force.hpp"

#include <algorithm>
#include <cmath>

namespace brainshift::solve {

namespace {

constexpr double in_micronewton = 1e-3;  // kg/m³ m/s² to µN/mm³

/// Where a point of some volume stands to the level: its share above, and the mean over it of max(0, h), mm. Taken for
/// a cube whose edge is along gravity.
struct Above {
  double share, height;

  Above(double height_of_point, double volume) {
    const double edge = std::cbrt(volume);
    const double top = height_of_point + edge / 2;
    share = std::clamp(top / edge, 0.0, 1.0);
    height = share < 1 ? share * std::max(0.0, top) / 2 : height_of_point;
  }
};

/// Whether eight equal points lie as Gauss's in a box: the product of their variances along its sides is (8 v)²/12³.
/// The middles of octants, which a cell that was split has, lie nearer together.
bool are_gauss_points(const Points& points, double volume) {
  const Eigen::MatrixX3d from_middle = points.rowwise() - Eigen::RowVector3d(points.colwise().mean());
  const Eigen::Matrix3d variance = from_middle.transpose() * from_middle / 8;
  const double expected = 64 * volume * volume / 1728;
  return std::abs(variance.determinant() - expected) < 0.05 * expected;
}

/// The middle of what each point stands for: of a cell with eight of Gauss's, that of the octant.
Points middles(const IntegrationPoints& points) {
  Points middle = points.positions;
  constexpr std::size_t octants = 8;
  const double inwards = std::sqrt(3) / 2;  // 1/4 over Gauss's 1/(2√3)
  for (std::size_t first = 0, next = 0; first < points.size(); first = next) {
    while (next < points.size() && points.cell[next] == points.cell[first]) {
      ++next;
    }
    const auto equal = [&](double volume) { return std::abs(volume - points.volume[first]) < 1e-9 * volume; };
    if (next - first == octants && std::all_of(points.volume.begin() + static_cast<std::ptrdiff_t>(first),
                                               points.volume.begin() + static_cast<std::ptrdiff_t>(next), equal)) {
      auto of_cell = middle.middleRows(static_cast<Eigen::Index>(first), octants);
      if (!are_gauss_points(of_cell, points.volume[first])) {
        continue;
      }
      const Eigen::RowVector3d centre = of_cell.colwise().mean();
      of_cell = (inwards * (of_cell.rowwise() - centre)).rowwise() + centre;
    }
  }
  return middle;
}

}  // namespace

double highest(const Eigen::Vector3d& gravity, const Points& points) {
  return (points * gravity.normalized()).minCoeff();
}

double drained_level(const Eigen::Vector3d& gravity, double share, const Points& points) {
  const Eigen::VectorXd along = points * gravity.normalized();
  return along.minCoeff() + share * (along.maxCoeff() - along.minCoeff());
}

void add_fluid_force(const DrainedFluid& fluid, const std::map<std::int32_t, Material>& materials,
                     const IntegrationPoints& points, const ShapeRows& rows, NodalVectors& total) {
  const Eigen::Vector3d down = fluid.gravity.normalized();
  const Eigen::Vector3d fluid_weight = in_micronewton * fluid.density * fluid.gravity;
  const Points middle = middles(points);
  const Eigen::Vector3d turned = fluid.gravity - fluid.gravity_of_image;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Material& material = materials.at(points.label[i]);
    if (material.room == Room::drained) {
      continue;
    }
    const Above above(fluid.level - middle.row(static_cast<Eigen::Index>(i)).dot(down), points.volume[i]);
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
