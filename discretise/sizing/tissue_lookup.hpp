// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <utility>

#include "segmentation/geometry/points.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::discretise {

/// The tissue at any place: the label of the voxel there when it is of the brain, else of the nearest brain voxel.
/// Const calls may run on many threads.
class TissueLookup {
 public:
  /// labels may be null: everything is tissue 1. Throws std::invalid_argument when no voxel has a brain label.
  TissueLookup(const LabelMap* labels, std::span<const std::int32_t> brain_labels);

  std::int32_t tissue_at(const Eigen::Vector3d& world) const;
  /// The voxel there is of the brain; true everywhere without labels.
  bool in_brain(const Eigen::Vector3d& world) const;

 private:
  struct Rim;
  const LabelMap* labels_;
  std::vector<std::int32_t> brain_labels_;
  std::shared_ptr<const Rim> rim_;
};

/// Centres of the voxels of a label, mm.
Points label_voxels(const LabelMap& labels, std::int32_t label);

/// Centres of the voxel faces between two brain labels, mm, but of those that are alike (DiscretiseOptions::alike).
Points tissue_boundary(const LabelMap& labels, std::span<const std::int32_t> brain_labels,
                       const std::set<std::pair<std::int32_t, std::int32_t>>& alike = {});

}  // namespace brainshift::discretise
