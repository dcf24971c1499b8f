// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "segmentation/surface/extract.hpp"

namespace brainshift::segmentation {
namespace {

bool inside(const Mask& mask, const Eigen::Array3i& voxel) {
  const bool in_image = (voxel >= 0).all() && (voxel < mask.geometry.size).all();
  return in_image && mask.at(voxel.x(), voxel.y(), voxel.z()) != 0;
}

// Squared distance from a point to the face that a voxel shares with the next one along the axis; both scaled to mm.
double squared_distance_to_face(const Eigen::Array3d& point, const Eigen::Array3i& voxel, int axis,
                                const Eigen::Array3d& spacing) {
  Eigen::Array3d lower = (voxel.cast<double>() - 0.5) * spacing;
  Eigen::Array3d upper = (voxel.cast<double>() + 0.5) * spacing;
  lower[axis] = upper[axis];
  return (point - point.max(lower).min(upper)).matrix().squaredNorm();
}

// Looks at the voxels up to `reach` away from the point's own; infinite when no face is there.
double squared_distance_within(const Mask& mask, const Eigen::Array3d& index, int reach) {
  const Eigen::Array3d spacing = mask.geometry.spacing.array();
  const Eigen::Array3i centre = index.round().cast<int>();
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = -reach; k <= reach; ++k) {
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        const Eigen::Array3i voxel = centre + Eigen::Array3i(i, j, k);
        const bool is_inside = inside(mask, voxel);
        for (int axis = 0; axis < 3; ++axis) {
          Eigen::Array3i next = voxel;
          ++next[axis];
          if (inside(mask, next) != is_inside) {
            nearest = std::min(nearest, squared_distance_to_face(index * spacing, voxel, axis, spacing));
          }
        }
      }
    }
  }
  return nearest;
}

// A surface that lies farther off is none of the mask's: how far does not matter, and to look for it takes minutes.
double distance_to_boundary(const Mask& mask, const Eigen::Vector3d& point) {
  const Eigen::Array3d index = mask.geometry.to_index(point).array();
  const double spacing = mask.geometry.spacing.minCoeff();
  constexpr int farthest = 8;
  for (int reach = 1;; reach *= 2) {
    const double distance = std::sqrt(squared_distance_within(mask, index, reach));
    const double certain = (reach - 0.5) * spacing;  // what lies outside the box looked at is farther than this
    if (distance <= certain || reach == farthest) {
      return std::min(distance, certain);
    }
  }
}

// Corner weights of points that stand for equal parts of a triangle.
constexpr std::array<std::array<double, 3>, 4> samples = {{{2.0 / 3, 1.0 / 6, 1.0 / 6},
                                                           {1.0 / 6, 2.0 / 3, 1.0 / 6},
                                                           {1.0 / 6, 1.0 / 6, 2.0 / 3},
                                                           {1.0 / 3, 1.0 / 3, 1.0 / 3}}};

struct Sample {
  double distance;
  double area;
};

std::vector<Sample> sampled_distances(const Surface& surface, const Mask& mask) {
  std::vector<Sample> result(static_cast<std::size_t>(surface.triangles.rows()) * samples.size());
#pragma omp parallel for schedule(static)
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const Eigen::Vector3d a = surface.vertices.row(surface.triangles(t, 0));
    const Eigen::Vector3d b = surface.vertices.row(surface.triangles(t, 1));
    const Eigen::Vector3d c = surface.vertices.row(surface.triangles(t, 2));
    const double area = (b - a).cross(c - a).norm();
    for (std::size_t s = 0; s < samples.size(); ++s) {
      const Eigen::Vector3d point = samples[s][0] * a + samples[s][1] * b + samples[s][2] * c;
      result[static_cast<std::size_t>(t) * samples.size() + s] = {distance_to_boundary(mask, point), area};
    }
  }
  return result;
}

}  // namespace

double boundary_distance_95(const Surface& surface, const Mask& mask) {
  std::vector<Sample> sampled = sampled_distances(surface, mask);
  std::sort(sampled.begin(), sampled.end(), [](const Sample& a, const Sample& b) { return a.distance < b.distance; });
  const double total = std::accumulate(sampled.begin(), sampled.end(), 0.0,
                                       [](double sum, const Sample& sample) { return sum + sample.area; });
  double below = 0;
  for (const Sample& sample : sampled) {
    below += sample.area;
    if (below >= 0.95 * total) {
      return sample.distance;
    }
  }
  return 0;
}

}  // namespace brainshift::segmentation
