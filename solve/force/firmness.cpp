// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/firmness.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solve/force/point_derivatives.hpp"

namespace brainshift::solve {

std::vector<double> felt_tissues(const PointBlocks& points, std::size_t tissues) {
  if (tissues < 2) {
    return {};
  }
  std::vector<double> felt(points.nodes() * tissues, 0.0);
  for (const Block& block : points.blocks) {
    for (std::int32_t k = block.first_patch; k < block.last_patch; ++k) {
      const Patch& patch = points.patches[static_cast<std::size_t>(k)];
      for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
        const Eigen::Matrix3Xd b = derivatives(points, p);
        Eigen::Index a = 0;
        for (const std::uint16_t slot : points.slots_of(p)) {
          const auto node = static_cast<std::size_t>(points.node_of(block, slot));
          felt[node * tissues + static_cast<std::size_t>(patch.material)] +=
              points.volume[static_cast<std::size_t>(p)] * b.col(a++).squaredNorm();
        }
      }
    }
  }
  return felt;
}

std::vector<double> node_firmness(const PointBlocks& points, std::span<const double> shear_modulus) {
  if (points.felt.empty()) {
    return {};
  }
  std::vector<double> firmness;
  for (auto felt = points.felt.begin(); felt != points.felt.end(); felt += std::ssize(shear_modulus)) {
    const double all = std::accumulate(felt, felt + std::ssize(shear_modulus), 0.0);
    const double modulus = std::inner_product(shear_modulus.begin(), shear_modulus.end(), felt, 0.0);
    firmness.push_back(all > 0 ? std::sqrt(modulus / all) : 1.0);
  }
  return firmness;
}

std::span<const double> NodeShares::of(std::span<const std::uint16_t> slots, std::span<const double> reach) {
  share_.assign(slots.size(), 1.0);
  if (firmness_.empty()) {
    return share_;
  }
  double firmest = 0;
  for (std::size_t a = 0; a < slots.size(); ++a) {
    share_[a] = firmness_[static_cast<std::size_t>(points_.node_of(block_, slots[a]))];
    firmest = std::max(firmest, share_[a]);
  }
  double soft = 0, all = 0;
  for (std::size_t a = 0; a < slots.size(); ++a) {
    share_[a] /= firmest;
    soft += reach[a] * (1 - share_[a]);
    all += reach[a];
  }
  const double least = all > 0 ? soft / all : 1.0;
  for (double& share : share_) {
    share = std::max(share, least);
  }
  return share_;
}

}  // namespace brainshift::solve
