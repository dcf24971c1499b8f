// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/stiffness_bound.hpp"

#include <algorithm>
#include <cmath>

#include "solve/arrays/shared_work.hpp"
#include "solve/force/firmness.hpp"
#include "solve/force/internal_force.hpp"
#include "solve/force/patch_dilatation.hpp"
#include "solve/force/point_derivatives.hpp"
#include "solve/material/symmetric_eigen.hpp"

namespace brainshift::solve {

double weighted_norm(const Eigen::Matrix3Xd& b, std::span<const double> share) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (Eigen::Index a = 0; a < b.cols(); ++a) {
    const double norm = b.col(a).norm();
    if (norm > 0) {
      sum += b.col(a) * b.col(a).transpose() / (share[static_cast<std::size_t>(a)] * norm);
    }
  }
  return symmetric_eigenvalues(sum)[2];
}

namespace {

/// Sums over the slots of a block.
struct BlockSums {
  double* bound;
  std::vector<Eigen::Matrix<double, 3, 4>> mode;  ///< one a slot: b of each pressure mode; zero between patches
  std::vector<const Patch*> last;                 ///< one a slot: the last patch that touched it
  std::vector<double> reach;                      ///< one a slot: Σ w |B| over the patch; zero between patches
  std::vector<std::uint16_t> touched;             ///< slots of the patch
  NodeShares shares;

  BlockSums(const PointBlocks& points, const Block& block, std::span<const double> firmness, double* of_slots)
      : bound(of_slots + block.first_slot),
        mode(static_cast<std::size_t>(block.slots), Eigen::Matrix<double, 3, 4>::Zero()),
        last(static_cast<std::size_t>(block.slots), nullptr),
        reach(static_cast<std::size_t>(block.slots), 0.0),
        shares(points, block, firmness) {}
};

template <class ElasticLaw>
void add_shape_bound(const PointBlocks& points, const Patch& patch, const ElasticLaw& law, double growth,
                     std::span<const Eigen::Matrix3d> gradients, BlockSums& sums) {
  const Eigen::Vector4d dilatations = projected_dilatation(points, patch, law, gradients);
  for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
    const Eigen::Matrix3d& gradient = gradients[static_cast<std::size_t>(p - patch.first_point)];
    const double dilatation = law.dilatation(Deformation(gradient));
    const double pressure = point_pressure(law, dilatations.dot(points.modes_of(p)), dilatation);
    const auto b = derivatives(points, p);
    const std::vector<double> reach = column_norms(b);
    const std::span<const std::uint16_t> slots = points.slots_of(p);
    const std::span<const double> share = sums.shares.of(slots, reach);
    const double scale = growth * points.volume[static_cast<std::size_t>(p)] *
                         shape_tangent(law, gradient, pressure, dilatation) * weighted_norm(b, share);
    for (std::size_t a = 0; a < slots.size(); ++a) {
      sums.bound[slots[a]] += scale * share[a] * reach[a];
    }
  }
}

/// b of each pressure mode and the reach at the slots that the patch touches.
template <class ElasticLaw>
void sum_over_patch(const PointBlocks& points, const Patch& patch, const ElasticLaw& law,
                    std::span<const Eigen::Matrix3d> gradients, BlockSums& sums) {
  sums.touched.clear();
  for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
    const double volume = points.volume[static_cast<std::size_t>(p)];
    const Eigen::Matrix3d slope =
        volume * law.dilatation_slope(Deformation(gradients[static_cast<std::size_t>(p - patch.first_point)]));
    const Eigen::RowVector4d modes = points.modes_of(p).transpose();
    const auto b = derivatives(points, p);
    Eigen::Index a = 0;
    for (const std::uint16_t slot : points.slots_of(p)) {
      sums.reach[slot] += volume * b.col(a).norm();
      sums.mode[slot] += slope * b.col(a++) * modes;
      if (sums.last[slot] != &patch) {
        sums.last[slot] = &patch;
        sums.touched.push_back(slot);
      }
    }
  }
}

template <class ElasticLaw>
void add_volume_bound(const PointBlocks& points, const Patch& patch, const ElasticLaw& law, double growth,
                      std::span<const Eigen::Matrix3d> gradients, BlockSums& sums) {
  sum_over_patch(points, patch, law, gradients, sums);
  std::vector<double> reach;
  for (const std::uint16_t slot : sums.touched) {
    reach.push_back(sums.reach[slot]);
  }
  const std::span<const double> share = sums.shares.of(sums.touched, reach);
  Eigen::RowVector4d total = Eigen::RowVector4d::Zero();
  for (std::size_t t = 0; t < share.size(); ++t) {
    total += sums.mode[sums.touched[t]].colwise().norm() / share[t];
  }
  for (std::size_t t = 0; t < share.size(); ++t) {
    const std::uint16_t slot = sums.touched[t];
    sums.bound[slot] += growth * law.bulk_modulus * share[t] * total.dot(sums.mode[slot].colwise().norm());
    sums.mode[slot].setZero();
    sums.reach[slot] = 0;
  }
}

std::vector<double> sum_at_nodes(const PointBlocks& points, const std::vector<double>& at_slots) {
  std::vector<double> sum(points.nodes(), 0.0);
  for (std::size_t slot = 0; slot < at_slots.size(); ++slot) {
    sum[static_cast<std::size_t>(points.slot_node[slot])] += at_slots[slot];
  }
  return sum;
}

}  // namespace

std::vector<double> stiffness_bound(const PointBlocks& points, const PointLaws& laws, const ForceScratch& scratch) {
  std::vector<double> slot_bound(points.slots(), 0.0);
  const std::vector<double> firmness = node_firmness(points, shear_moduli(laws));
  const auto blocks = static_cast<std::int64_t>(points.blocks.size());
  share_work(blocks, 1, [&](std::int64_t i) {
    const Block& block = points.blocks[static_cast<std::size_t>(i)];
    BlockSums sums(points, block, firmness, slot_bound.data());
    for (std::int32_t k = block.first_patch; k < block.last_patch; ++k) {
      const Patch& patch = points.patches[static_cast<std::size_t>(k)];
      const std::vector<Eigen::Matrix3d> gradients = gradients_of(points, patch, scratch);
      const double growth = scratch.growth_of(patch.material);
      std::visit(
          [&](const auto& law) {
            add_shape_bound(points, patch, law, growth, gradients, sums);
            add_volume_bound(points, patch, law, growth, gradients, sums);
          },
          laws.elastic[static_cast<std::size_t>(patch.material)]);
    }
  });
  return sum_at_nodes(points, slot_bound);
}

double critical_step(std::span<const double> stiffness_bound, std::span<const double> mass) {
  double largest = 0;
  for (std::size_t a = 0; a < mass.size(); ++a) {
    largest = std::max(largest, stiffness_bound[a] / mass[a]);
  }
  return 2 / std::sqrt(largest);
}

}  // namespace brainshift::solve
