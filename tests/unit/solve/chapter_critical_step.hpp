// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "solve/force/point_blocks.hpp"
#include "solve/material/material_table.hpp"

namespace brainshift::solve {

/// Masses as Wittek et al., eq. 21, have them, g, one a node: each point's shared evenly by the nodes of its support.
/// density: g/mm³, one a row of the material table.
inline std::vector<double> chapter_mass(const PointBlocks& points, std::span<const double> density) {
  std::vector<double> mass(points.nodes(), 0.0);
  for (const Block& block : points.blocks) {
    for (std::int32_t k = block.first_patch; k < block.last_patch; ++k) {
      const Patch& patch = points.patches[static_cast<std::size_t>(k)];
      for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
        const double share = density[static_cast<std::size_t>(patch.material)] *
                             points.volume[static_cast<std::size_t>(p)] / static_cast<double>(points.support_size(p));
        for (const std::uint16_t slot : points.slots_of(p)) {
          mass[static_cast<std::size_t>(points.node_of(block, slot))] += share;
        }
      }
    }
  }
  return mass;
}

/// c_d = sqrt((λ + 2µ)/ρ), mm/s: the speed of dilatational waves.
inline double wave_speed(const Material& material) {
  const double modulus = bulk_modulus(material) + 4 * shear_modulus(material) / 3;
  return std::sqrt(modulus / density_per_cubic_millimetre(material));
}

/// The critical step as Wittek et al. print it, eq. 25, with (λ + 2µ)/ρ: min over points of 2 / (c_d sqrt(N Σ|B|²)), s.
/// speed: c_d, mm/s, one a row of the material table; points in double precision. What the solver's own bound is
/// held against.
inline double chapter_critical_step(const PointBlocks& points, std::span<const double> speed) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Patch& patch : points.patches) {
    const double c = speed[static_cast<std::size_t>(patch.material)];
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      const auto nodes = static_cast<Eigen::Index>(points.support_size(p));
      const Eigen::Map<const Eigen::Matrix3Xd> derivative(points.derivatives_of<double>(p), 3, nodes);
      smallest = std::min(smallest, 2 / (c * std::sqrt(static_cast<double>(nodes) * derivative.squaredNorm())));
    }
  }
  return smallest;
}

}  // namespace brainshift::solve
