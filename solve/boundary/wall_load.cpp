// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/wall_load.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace brainshift::solve {

namespace {

/// Calls visit(centroid) for each of the n² equal pieces of a triangle.
template <class Visit>
void visit_pieces(const Triangle& whole, int n, const Visit& visit) {
  const Eigen::Vector3d along = (whole.b - whole.a) / n, across = (whole.c - whole.a) / n;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      visit(whole.a + (i + 1.0 / 3) * along + (j + 1.0 / 3) * across);
      if (i + j + 1 < n) {
        visit(whole.a + (i + 2.0 / 3) * along + (j + 2.0 / 3) * across);
      }
    }
  }
}

}  // namespace

bool presses_on_wall(const Resection& resection) {
  return resection.wall && (resection.pressure != 0 || resection.fluid_level);
}

std::function<double(const Eigen::Vector3d&)> cavity_pressure(const Model& model) {
  const Resection& resection = *model.resection;
  const double pressure = resection.pressure;
  if (!resection.fluid_level) {
    return [pressure](const Eigen::Vector3d&) { return pressure; };
  }
  constexpr double pascal = 1e-3;  // kg/m³ m/s² mm to Pa
  const DrainedFluid& fluid = *model.fluid;
  const double weight = pascal * fluid.density * fluid.gravity.norm();
  const Eigen::Vector3d down = fluid.gravity.normalized();
  return [=, level = *resection.fluid_level, outside = fluid.level](const Eigen::Vector3d& x) {
    const double depth = x.dot(down);
    return pressure + weight * (std::max(0.0, depth - level) - std::max(0.0, depth - outside));
  };
}

PlacedForces forces_on_wall(const Surface& wall, double longest,
                            const std::function<double(const Eigen::Vector3d&)>& pressure) {
  constexpr double newton = 1e-6;  // Pa mm² to N
  std::vector<Eigen::Vector3d> places, forces;
  for (Eigen::Index t = 0; t < wall.triangles.rows(); ++t) {
    const Triangle whole = triangle(wall, t);
    const double edge = std::max({(whole.b - whole.a).norm(), (whole.c - whole.b).norm(), (whole.a - whole.c).norm()});
    const int n = std::max(1, static_cast<int>(std::ceil(edge / longest)));
    const Eigen::Vector3d area = whole.area_vector() / (n * n);
    visit_pieces(whole, n, [&](const Eigen::Vector3d& x) {
      places.push_back(x);
      forces.emplace_back(newton * pressure(x) * area);
    });
  }
  return {as_points(places), as_points(forces)};
}

}  // namespace brainshift::solve
