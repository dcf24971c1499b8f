// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/sizing/tissue_lookup.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "segmentation/geometry/point_tree.hpp"

namespace brainshift::discretise {
namespace {

bool contains(std::span<const std::int32_t> labels, std::int32_t label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

template <class Visit>
void for_voxels(const LabelMap& labels, const Visit& visit) {
  const Eigen::Array3i size = labels.geometry.size;
  for (int k = 0; k < size.z(); ++k) {
    for (int j = 0; j < size.y(); ++j) {
      for (int i = 0; i < size.x(); ++i) {
        visit(Eigen::Array3i(i, j, k), labels.at(i, j, k));
      }
    }
  }
}

std::uint16_t neighbour(const LabelMap& labels, Eigen::Array3i voxel, int axis, int step) {
  voxel[axis] += step;
  const bool inside = voxel[axis] >= 0 && voxel[axis] < labels.geometry.size[axis];
  return inside ? labels.at(voxel.x(), voxel.y(), voxel.z()) : std::uint16_t{0};
}

Eigen::Vector3d centre(const LabelMap& labels, const Eigen::Array3i& voxel) {
  return labels.geometry.to_world(voxel.cast<double>().matrix());
}

}  // namespace

/// The brain's outermost voxels: the brain voxel nearest to a place outside is always one of them.
struct TissueLookup::Rim {
  Rim(Points points, std::vector<std::int32_t> labels)
      : centres(std::move(points)), label(std::move(labels)), tree(centres) {}

  Points centres;
  std::vector<std::int32_t> label;
  PointTree tree;
};

TissueLookup::TissueLookup(const LabelMap* labels, std::span<const std::int32_t> brain_labels)
    : labels_(labels), brain_labels_(brain_labels.begin(), brain_labels.end()) {
  if (labels_ == nullptr) {
    return;
  }
  std::vector<Eigen::Vector3d> centres;
  std::vector<std::int32_t> rim_labels;
  for_voxels(*labels_, [&](const Eigen::Array3i& voxel, std::uint16_t label) {
    if (!contains(brain_labels_, label)) {
      return;
    }
    bool outermost = false;
    for (int axis = 0; axis < 3 && !outermost; ++axis) {
      outermost = !contains(brain_labels_, neighbour(*labels_, voxel, axis, -1)) ||
                  !contains(brain_labels_, neighbour(*labels_, voxel, axis, 1));
    }
    if (outermost) {
      centres.push_back(centre(*labels_, voxel));
      rim_labels.push_back(label);
    }
  });
  if (centres.empty()) {
    throw std::invalid_argument(
        "the label map has no voxel with a brain label; check the labels of the brain's "
        "tissues.");
  }
  rim_ = std::make_shared<const Rim>(as_points(centres), std::move(rim_labels));
}

bool TissueLookup::in_brain(const Eigen::Vector3d& world) const {
  return labels_ == nullptr || contains(brain_labels_, label_at(*labels_, world));
}

std::int32_t TissueLookup::tissue_at(const Eigen::Vector3d& world) const {
  if (labels_ == nullptr) {
    return 1;
  }
  const std::int32_t label = label_at(*labels_, world);
  return contains(brain_labels_, label) ? label : rim_->label[rim_->tree.nearest(world.data()).first];
}

Points label_voxels(const LabelMap& labels, std::int32_t label) {
  std::vector<Eigen::Vector3d> centres;
  for_voxels(labels, [&](const Eigen::Array3i& voxel, std::uint16_t at) {
    if (at == label) {
      centres.push_back(centre(labels, voxel));
    }
  });
  return as_points(centres);
}

Points tissue_boundary(const LabelMap& labels, std::span<const std::int32_t> brain_labels,
                       const std::set<std::pair<std::int32_t, std::int32_t>>& alike) {
  std::vector<Eigen::Vector3d> faces;
  for_voxels(labels, [&](const Eigen::Array3i& voxel, std::uint16_t label) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::uint16_t next = neighbour(labels, voxel, axis, 1);
      if (next != label && contains(brain_labels, label) && contains(brain_labels, next) &&
          !alike.contains(std::minmax<std::int32_t>(label, next))) {
        Eigen::Vector3d index = voxel.cast<double>().matrix();
        index[axis] += 0.5;
        faces.push_back(labels.geometry.to_world(index));
      }
    }
  });
  return as_points(faces);
}

}  // namespace brainshift::discretise
