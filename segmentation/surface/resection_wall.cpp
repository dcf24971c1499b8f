// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/surface/resection_wall.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "segmentation/geometry/point_tree.hpp"
#include "segmentation/image/voxels.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift::segmentation {

namespace {

constexpr double reach = 4;  // mm that tissues go on outside the brain, at least
constexpr int reach_in_voxels = 3;

/// Of the shortest edges of voxels.
int reach_of(const ImageGeometry& grid) {
  return std::max(reach_in_voxels, static_cast<int>(std::ceil(reach / grid.spacing.minCoeff())));
}

/// mm; of thick slices beyond the next.
double farthest_of(const ImageGeometry& grid) {
  constexpr double slices = 1.5;
  return std::max(reach_of(grid) * grid.spacing.minCoeff(), slices * grid.spacing.maxCoeff());
}

template <class Visit>
void for_voxels(const ImageGeometry& grid, const Visit& visit) {
  for_each_voxel(grid.size,
                 [&](int i, int j, int k) { visit(grid.offset(i, j, k), grid.to_world(Eigen::Vector3d(i, j, k))); });
}

Points centres_of(const Mask& mask) {
  std::vector<Eigen::Vector3d> list;
  for_voxels(mask.geometry, [&](std::size_t voxel, const Eigen::Vector3d& centre) {
    if (mask.voxels[voxel] != 0) {
      list.push_back(centre);
    }
  });
  return as_points(list);
}

double distance(const PointTree& tree, const Eigen::Vector3d& x) {
  return std::sqrt(tree.nearest(x.data()).second);
}

/// With the voxels outside the brain, not farther than the reach, that are nearer to the mask than to other tissue.
Mask continued(const Mask& taken, const Mask& other) {
  Mask result = taken;
  const Points of_taken = centres_of(taken), of_other = centres_of(other);
  if (of_other.rows() == 0) {
    return grown(taken, farthest_of(taken.geometry));
  }
  const PointTree to_taken(of_taken), to_other(of_other);
  const double most = farthest_of(taken.geometry);
  for_voxels(taken.geometry, [&](std::size_t voxel, const Eigen::Vector3d& centre) {
    if (taken.voxels[voxel] == 0 && other.voxels[voxel] == 0) {
      const double near = distance(to_taken, centre);
      result.voxels[voxel] = near <= most && near < distance(to_other, centre) ? 1 : 0;
    }
  });
  return result;
}

}  // namespace

MeasuredSurface resection_wall(const LabelMap& labels, std::span<const std::uint16_t> brain,
                               std::span<const std::uint16_t> taken, double edge_length) {
  const Mask whole = mask_of(labels, taken);
  if (count(whole) == 0) {
    throw std::invalid_argument("the resection takes out label " + write_numbers(taken) +
                                ", which no voxel of the brain carries");
  }
  std::vector<std::uint16_t> left;
  std::ranges::copy_if(brain, std::back_inserter(left),
                       [&](std::uint16_t label) { return std::ranges::find(taken, label) == taken.end(); });
  const ImageGeometry& grid = labels.geometry;
  const int beyond = static_cast<int>(std::ceil(farthest_of(grid) / grid.spacing.minCoeff()));
  const Mask part = cropped(whole, reach_of(grid) + beyond);
  return extract_surface(continued(part, cropped_to(mask_of(labels, left), part.geometry)), edge_length,
                         "the resection");
}

}  // namespace brainshift::segmentation
