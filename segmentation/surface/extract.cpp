// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/surface/extract.hpp"

#include <cmath>
#include <stdexcept>

#include "segmentation/surface/remesh.hpp"

namespace brainshift::segmentation {
namespace {

SurfaceMeasures measured(const Surface& surface, const Mask& mask, double edge_length) {
  SurfaceMeasures measures = measure(surface);
  measures.label_volume = volume(mask);
  measures.boundary_distance_95 = boundary_distance_95(surface, mask);
  measures.edge_length_target = edge_length;
  return measures;
}

// volume_before: before it was fitted. A surface that has to swell much to hold its volume has lost its thin parts.
bool faithful(const SurfaceMeasures& measures, double volume_before) {
  return std::abs(volume_before - measures.label_volume) <= 0.05 * measures.label_volume &&
         std::abs(measures.volume - measures.label_volume) <= 0.01 * measures.label_volume &&
         measures.boundary_distance_95 <= 1.0;
}

MeasuredSurface fitted(Surface surface, const Mask& mask, double edge_length) {
  fit_volume(surface, volume(mask));
  SurfaceMeasures measures = measured(surface, mask, edge_length);
  return {std::move(surface), measures};
}

}  // namespace

MeasuredSurface extract_surface(const Mask& mask, double edge_length, const std::string& what) {
  const double voxel = mask.geometry.spacing.maxCoeff();
  MeasuredSurface best;
  double edge = edge_length;
  double sigma = std::max(0.6 * voxel, 0.3 * edge_length);
  constexpr int attempts = 5;
  for (int i = 0; i < attempts; ++i) {
    Surface surface = remeshed(iso_surface(mask, sigma), edge);
    const double volume_before = volume(surface);
    MeasuredSurface candidate = fitted(std::move(surface), mask, edge);
    if (candidate.measures.is_sound()) {
      best = std::move(candidate);
      if (faithful(best.measures, volume_before)) {
        return best;
      }
    }
    edge *= 0.7;
    sigma *= i + 2 < attempts ? 0.7 : 0.0;
  }
  if (!best.measures.is_sound()) {
    best = fitted(remeshed(wrapped(iso_surface(mask, 0), edge), edge), mask, edge);
    best.measures.repaired = true;
  }
  if (!best.measures.is_sound()) {
    throw std::invalid_argument("no closed surface free of self-intersection could be made of " + what +
                                "; smooth the labels or use a finer edge length");
  }
  return best;
}

}  // namespace brainshift::segmentation
