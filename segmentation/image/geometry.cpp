// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "segmentation/image/image.hpp"

namespace brainshift {

Eigen::Vector3d ImageGeometry::to_world(const Eigen::Vector3d& index) const {
  return origin + direction * spacing.cwiseProduct(index);
}

Eigen::Vector3d ImageGeometry::to_index(const Eigen::Vector3d& world) const {
  const Eigen::Matrix3d inverse = direction.inverse();
  return (inverse * (world - origin)).cwiseQuotient(spacing);
}

Eigen::Matrix3d ImageGeometry::index_from_world() const {
  return (direction * spacing.asDiagonal()).inverse();
}

bool same_geometry(const ImageGeometry& a, const ImageGeometry& b) {
  if ((a.size != b.size).any()) {
    return false;
  }
  const double tolerance = 1e-3 * std::min(a.spacing.minCoeff(), b.spacing.minCoeff());
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Array3i picked(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    const Eigen::Vector3d index = (picked * (a.size - 1)).cast<double>().matrix();
    const double distance = (a.to_world(index) - b.to_world(index)).norm();
    if (!(distance <= tolerance)) {
      return false;
    }
  }
  return true;
}

bool has_label(const LabelMap& labels, std::int32_t label) {
  return std::ranges::find(labels.voxels, label) != labels.voxels.end();
}

std::uint16_t label_at(const LabelMap& labels, const Eigen::Vector3d& world) {
  return label_at_index(labels, labels.geometry.to_index(world));
}

std::uint16_t label_at_index(const LabelMap& labels, const Eigen::Vector3d& index) {
  const ImageGeometry& geometry = labels.geometry;
  Eigen::Array3i nearest;
  for (int axis = 0; axis < 3; ++axis) {
    const bool inside = index[axis] >= -0.5 && index[axis] <= geometry.size[axis] - 0.5;
    if (!inside) {
      return 0;
    }
    nearest[axis] = std::clamp(static_cast<int>(std::lround(index[axis])), 0, geometry.size[axis] - 1);
  }
  return labels.at(nearest.x(), nearest.y(), nearest.z());
}

namespace {

/// Halfway between voxels the label that most of them have. Of labels that as many have the lowest and the highest take
/// turns: always the same side would move the whole map by half a voxel.
std::uint16_t label_between(const LabelMap& labels, const Eigen::Vector3d& index, bool lowest) {
  constexpr double halfway = 0.499;
  std::array<std::uint16_t, 8> votes{};
  std::size_t count = 1;
  std::array<Eigen::Array3i, 8> voxels{index.array().round().cast<int>()};
  for (int axis = 0; axis < 3; ++axis) {
    const double beyond = index[axis] - voxels[0][axis];
    if (std::abs(beyond) > halfway) {
      for (std::size_t k = 0; k < count; ++k) {
        voxels[count + k] = voxels[k];
        voxels[count + k][axis] += beyond > 0 ? 1 : -1;
      }
      count *= 2;
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    const bool inside = (voxels[k] >= 0).all() && (voxels[k] < labels.geometry.size).all();
    votes[k] = inside ? labels.at(voxels[k].x(), voxels[k].y(), voxels[k].z()) : std::uint16_t{0};
  }
  std::sort(votes.begin(), votes.begin() + static_cast<std::ptrdiff_t>(count));
  std::uint16_t chosen = votes[0];
  std::size_t most = 0;
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    while (last < count && votes[last] == votes[first]) {
      ++last;
    }
    if (last - first > most || (last - first == most && !lowest)) {
      most = last - first;
      chosen = votes[first];
    }
  }
  return chosen;
}

}  // namespace

LabelMap on_grid(const LabelMap& labels, const ImageGeometry& grid) {
  LabelMap result{grid, std::vector<std::uint16_t>(grid.voxel_count())};
  // World positions along a row differ by one step, and so do the map's indices.
  const auto at = [&](int i, int j, int k) {
    return labels.geometry.to_index(grid.to_world(Eigen::Array3i(i, j, k).cast<double>().matrix()));
  };
  const Eigen::Vector3d step = at(1, 0, 0) - at(0, 0, 0);
#pragma omp parallel for schedule(static)
  for (int k = 0; k < grid.size.z(); ++k) {
    for (int j = 0; j < grid.size.y(); ++j) {
      const Eigen::Vector3d first = at(0, j, k);
      for (int i = 0; i < grid.size.x(); ++i) {
        result.at(i, j, k) = label_between(labels, first + i * step, (i + j + k) % 2 == 0);
      }
    }
  }
  return result;
}

double share_within(const LabelMap& labels, const ImageGeometry& grid) {
  std::size_t all = 0, within = 0;
  const Eigen::Array3i size = labels.geometry.size;
#pragma omp parallel for schedule(static) reduction(+ : all, within)
  for (int k = 0; k < size.z(); ++k) {
    for (int j = 0; j < size.y(); ++j) {
      for (int i = 0; i < size.x(); ++i) {
        if (labels.at(i, j, k) != 0) {
          const Eigen::Vector3d world = labels.geometry.to_world(Eigen::Array3i(i, j, k).cast<double>().matrix());
          const Eigen::Array3d index = grid.to_index(world).array();
          ++all;
          within += (index >= -0.5).all() && (index <= grid.size.cast<double>() - 0.5).all() ? 1 : 0;
        }
      }
    }
  }
  return all == 0 ? 1 : static_cast<double>(within) / static_cast<double>(all);
}

std::string described(const ImageGeometry& geometry) {
  std::ostringstream text;
  text << geometry.size.x() << " x " << geometry.size.y() << " x " << geometry.size.z() << " voxels of "
       << geometry.spacing.x() << " x " << geometry.spacing.y() << " x " << geometry.spacing.z() << " mm from ("
       << geometry.origin.x() << ", " << geometry.origin.y() << ", " << geometry.origin.z() << ")";
  return text.str();
}

}  // namespace brainshift
