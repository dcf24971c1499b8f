// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/largest_eigenvalue.hpp"

#include <cmath>
#include <random>

namespace brainshift::solve {

NodalVectors rough_mode(std::size_t nodes) {
  NodalVectors mode(4 * nodes, 0.0);
  std::mt19937 random(1);
  for (std::size_t i = 0; i < mode.size(); ++i) {
    mode[i] = i % 4 < 3 ? static_cast<double>(random() % 2001) - 1000.0 : 0.0;
  }
  return mode;
}

double largest_eigenvalue(const PointBlocks& points, const PointLaws& laws, std::span<const double> mass,
                          int iterations) {
  const std::size_t nodes = points.nodes();
  ForceScratch scratch(points, laws);
  NodalVectors mode = rough_mode(nodes), force(4 * nodes);
  double eigenvalue = 0;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const double norm = std::sqrt(sum_over_nodes(nodes, [&](std::size_t a) { return at(mode, a).squaredNorm(); }));
    const double scale = small_mode * std::sqrt(static_cast<double>(nodes)) / norm;
    for (double& x : mode) {
      x *= scale;
    }
    internal_force(points, laws, mode, scratch, force);
    const double inertia = sum_over_nodes(nodes, [&](std::size_t a) { return mass[a] * at(mode, a).squaredNorm(); });
    eigenvalue = sum_over_nodes(nodes, [&](std::size_t a) { return at(mode, a).dot(at(force, a)); }) / inertia;
    for (std::size_t i = 0; i < mode.size(); ++i) {
      mode[i] = force[i] / mass[i / 4];
    }
  }
  return eigenvalue;
}

double bound_tightness(const PointBlocks& points, const PointLaws& laws, std::span<const double> bound,
                       std::span<const double> mass) {
  double largest = 0;
  for (std::size_t a = 0; a < mass.size(); ++a) {
    largest = std::max(largest, bound[a] / mass[a]);
  }
  return std::min(1.0, tightness_margin * largest_eigenvalue(points, laws, mass, tightness_iterations) / largest);
}

}  // namespace brainshift::solve
