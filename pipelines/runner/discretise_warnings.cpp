// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/discretise_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "segmentation/image/voxels.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift::pipelines {
namespace {

struct Bulk {
  Eigen::Vector3d middle;  ///< mm
  double volume;           ///< mm³
};

/// Of what a closed surface holds.
Bulk bulk_of(const Surface& surface) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double volume = 0;
  const Eigen::Vector3d origin = surface.vertices.row(0);
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const Triangle corners = triangle(surface, t);
    const Eigen::Vector3d a = corners.a - origin, b = corners.b - origin, c = corners.c - origin;
    const double of_tetrahedron = a.dot(b.cross(c)) / 6;
    volume += of_tetrahedron;
    moment += of_tetrahedron * (a + b + c) / 4;
  }
  return {origin + moment / volume, volume};
}

/// Of the voxels with these labels; there is one.
Bulk bulk_of(const LabelMap& labels, const std::vector<std::int32_t>& counted) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for_each_voxel(labels.geometry.size, [&](int i, int j, int k) {
    if (std::ranges::find(counted, labels.at(i, j, k)) != counted.end()) {
      sum += Eigen::Vector3d(i, j, k);
      ++count;
    }
  });
  return {labels.geometry.to_world(sum / count), count * labels.geometry.spacing.prod()};
}

}  // namespace

Warnings warnings_of(const Surface& brain, const LabelMap& labels, const discretise::DiscretiseOptions& options) {
  constexpr double far = 3;       // mm; bodies that segment makes are within one
  constexpr double alike = 0.05;  // of the volume: beyond, as with a large hole, the middles need not agree
  Warnings warnings;
  const Bulk body = bulk_of(brain), drawn = bulk_of(labels, options.brain_labels);
  const double apart = (body.middle - drawn.middle).norm();
  if (apart > std::max(far, labels.geometry.spacing.maxCoeff()) &&
      std::abs(body.volume - drawn.volume) < alike * body.volume) {
    warnings.push_back("the middle of the surface is " + with_decimals(apart) +
                       " mm away from that of the brain's labels; are both of one patient and in one frame: mm, LPS?");
  }
  if (options.tumour_factor < 1 && std::ranges::find(labels.voxels, options.tumour_label) == labels.voxels.end()) {
    warnings.push_back("nodes are to be finer at a tumour (tumour_factor), but no voxel has its label " +
                       std::to_string(options.tumour_label) + "; give its number as tumour_label");
  }
  return warnings;
}

}  // namespace brainshift::pipelines
