// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/nodal_mass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brainshift::solve {

std::vector<double> relaxation_mass(const PointBlocks& points, std::span<const double> tangent_moduli) {
  std::vector<double> slot_mass(points.slots(), 0.0);
  const auto blocks = static_cast<std::int64_t>(points.blocks.size());
#pragma omp parallel for schedule(dynamic)
  for (std::int64_t i = 0; i < blocks; ++i) {
    const Block& block = points.blocks[static_cast<std::size_t>(i)];
    const std::int32_t first = points.patches[static_cast<std::size_t>(block.first_patch)].first_point;
    const std::int32_t last = points.patches[static_cast<std::size_t>(block.last_patch - 1)].last_point;
    for (std::int32_t p = first; p < last; ++p) {
      const Eigen::Map<const Eigen::Matrix3Xd> b(points.derivatives_of(p), 3,
                                                 static_cast<Eigen::Index>(points.support_size(p)));
      const double scale = points.volume[static_cast<std::size_t>(p)] * tangent_moduli[static_cast<std::size_t>(p)] *
                           b.colwise().norm().sum();
      Eigen::Index a = 0;
      for (const std::uint16_t slot : points.slots_of(p)) {
        slot_mass[static_cast<std::size_t>(block.first_slot) + slot] += scale * b.col(a++).norm();
      }
    }
  }
  std::vector<double> mass(points.nodes(), 0.0);
  for (std::size_t slot = 0; slot < slot_mass.size(); ++slot) {
    mass[static_cast<std::size_t>(points.slot_node[slot])] += slot_mass[slot];
  }
  return mass;
}

double critical_step(const PointBlocks& points, std::span<const double> wave_speed) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Patch& patch : points.patches) {
    const double c = wave_speed[static_cast<std::size_t>(patch.material)];
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      const auto n = static_cast<double>(points.support_size(p));
      const Eigen::Map<const Eigen::VectorXd> b(points.derivatives_of(p), static_cast<Eigen::Index>(3 * n));
      smallest = std::min(smallest, 2 / (c * std::sqrt(n * b.squaredNorm())));
    }
  }
  return smallest;
}

}  // namespace brainshift::solve
