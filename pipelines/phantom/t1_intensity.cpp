// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "pipelines/phantom/head.hpp"
#include "pipelines/phantom/texture.hpp"
#include "segmentation/segment.hpp"

namespace brainshift::pipelines {

namespace {

using Eigen::Vector3d;
namespace tissue = segmentation::default_label;

// 0 below the edge, 1 above it, over a width that stands for the scanner's blur.
double edge(double distance, double width) {
  return std::clamp(0.5 + distance / width, 0.0, 1.0);
}

// Folds: where a slow noise crosses zero near the surface runs a sulcus, dark and lined with grey matter.
double parenchyma_intensity(const Head& head, const Vector3d& point, std::uint64_t seed) {
  const double scale = head.scale;
  const Vector3d p = (point - head.brain.centre) / scale;
  const double depth = p.norm() * (1.0 / std::max(0.05, head.brain.level(point)) - 1.0);
  const double fold = smooth_noise(p, 17, seed) + 0.5 * smooth_noise(p, 9, seed + 1);
  const double from_sulcus = std::abs(fold) * 14;
  const double sulcus_depth = 13 + 5 * smooth_noise(p, 23, seed + 2);
  const double below_sulcus = std::max(0.0, depth - sulcus_depth);
  const double from_fluid = std::min(depth + 1.0, std::hypot(from_sulcus, below_sulcus));
  const double white = edge(from_fluid - 4.5, 2.0);
  const double fluid = 1.0 - edge(std::hypot(from_sulcus, below_sulcus) - 0.9, 1.2);
  const double tissue_value = 560 + 220 * white + 35 * smooth_noise(p, 6, seed + 3) + 25 * smooth_noise(p, 3, seed + 4);
  return tissue_value + (210 - tissue_value) * 0.8 * fluid;
}

double tumour_intensity(const Head& head, const Vector3d& point, std::uint64_t seed) {
  const Vector3d p = (point - head.brain.centre) / head.scale;
  const double rim = edge(head.tumour.level(point) - 0.78, 0.15);
  return 430 + 480 * rim + 70 * smooth_noise(p, 4, seed + 5);
}

}  // namespace

double t1_intensity(const Head& head, const Vector3d& point, std::uint64_t seed) {
  const Vector3d p = (point - head.brain.centre) / head.scale;
  switch (tissue_at(head, point)) {
    case tissue::parenchyma:
      return parenchyma_intensity(head, point, seed);
    case tissue::ventricles:
      return 190 + 15 * smooth_noise(p, 5, seed + 6);
    case tissue::tumour:
      return tumour_intensity(head, point, seed);
    case tissue::csf:
      return 210 + 20 * smooth_noise(p, 5, seed + 6);
    case tissue::skull:
      return 110 + 60 * std::max(0.0, smooth_noise(p, 5, seed + 7));
    case tissue::skin:
      return 720 + 110 * smooth_noise(p, 8, seed + 8);
    default:
      return 12 + 8 * smooth_noise(p, 4, seed + 9);
  }
}

}  // namespace brainshift::pipelines
