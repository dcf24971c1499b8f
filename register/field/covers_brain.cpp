// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/covers_brain.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "segmentation/geometry/point_tree.hpp"

namespace brainshift::registration {

namespace {

constexpr double spacings_apart = 2;

[[noreturn]] void not_of_this_brain(double share, const std::string& what) {
  throw std::invalid_argument("the solution is not of this brain: " + std::to_string(std::lround(100 * share)) +
                              " % of " + what + "; its nodes must fill the undeformed brain, in mm, LPS");
}

/// Of at most some thousand voxels of the brain, evenly.
double share_without_nodes(const Solution& solution, const BrainZones& zones, const ImageGeometry& geometry) {
  constexpr std::size_t samples = 5000;
  const auto voxels = static_cast<std::size_t>(std::ranges::count(zones.zone, Zone::brain));
  const std::size_t every = std::max<std::size_t>(1, voxels / samples);
  const PointTree nodes(solution.positions);
  std::size_t seen = 0, taken = 0, without = 0;
  for (std::size_t offset = 0; offset < zones.zone.size(); ++offset) {
    if (zones.zone[offset] != Zone::brain || seen++ % every != 0) {
      continue;
    }
    const auto i = static_cast<int>(offset);
    const int nx = geometry.size[0], ny = geometry.size[1];
    const Eigen::Vector3d x = geometry.to_world(Eigen::Vector3d(i % nx, i / nx % ny, i / nx / ny));
    const auto [node, squared] = nodes.nearest(x.data());
    ++taken;
    without += std::sqrt(squared) > spacings_apart * solution.spacing[node] ? 1 : 0;
  }
  return static_cast<double>(without) / static_cast<double>(std::max<std::size_t>(1, taken));
}

double share_outside(const Solution& solution, const BrainZones& zones) {
  std::size_t outside = 0;
  for (Eigen::Index a = 0; a < solution.positions.rows(); ++a) {
    const Eigen::Vector3d x = solution.positions.row(a);
    const double too_far =
        std::min(spacings_apart * solution.spacing[static_cast<std::size_t>(a)], zones.outside.horizon());
    outside += zones.outside.value(x) >= too_far ? 1 : 0;
  }
  return static_cast<double>(outside) / static_cast<double>(solution.positions.rows());
}

}  // namespace

void check_covers(const Solution& solution, const BrainZones& zones, const ImageGeometry& geometry) {
  constexpr double much = 0.05;  // of clouds of ours there is next to none
  if (const double share = share_without_nodes(solution, zones, geometry); share > much) {
    not_of_this_brain(share, "it lies over two spacings from every node");
  }
  if (const double share = share_outside(solution, zones); share > much) {
    not_of_this_brain(share, "the nodes lie over two spacings outside it");
  }
}

}  // namespace brainshift::registration
