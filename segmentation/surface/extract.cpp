// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/surface/extract.hpp"

#include <cmath>
#include <stdexcept>

#include "segmentation/surface/remesh.hpp"

namespace brainshift::segmentation {
namespace {

// Remeshing a contour of so many triangles takes seconds. One that needs more is folded, and finer edges do not help
// it.
constexpr Eigen::Index most_triangles = 100'000;

SurfaceMeasures measured(const Surface& surface, const Mask& mask, double edge_length) {
  SurfaceMeasures measures = measure(surface);
  measures.label_volume = volume(mask);
  measures.boundary_distance_95 = boundary_distance_95(surface, mask);
  measures.edge_length_target = edge_length;
  return measures;
}

bool faithful(const SurfaceMeasures& measures) {
  return measures.lost_before <= most_lost_before &&
         std::abs(measures.volume - measures.label_volume) <= 0.01 * measures.label_volume &&
         measures.boundary_distance_95 <= 1.0;
}

MeasuredSurface fitted(Surface surface, const Mask& mask, double edge_length) {
  const double before = volume(surface);
  fit_volume(surface, volume(mask));
  SurfaceMeasures measures = measured(surface, mask, edge_length);
  measures.lost_before = std::abs(before / measures.label_volume - 1);
  measures.within_bounds = faithful(measures);
  return {std::move(surface), measures};
}

// Smoother until it is sound, then wrapped.
MeasuredSurface rescued(const Mask& mask, double edge_length, double sigma, const std::string& what) {
  Surface contour = iso_surface(mask, sigma);
  for (; sigma > 0 && contour.triangles.rows() > most_triangles; contour = iso_surface(mask, sigma)) {
    sigma *= 2;
  }
  if (contour.triangles.rows() == 0) {
    throw std::invalid_argument("the " + what + " is so full of gaps that a smooth surface holds nothing of it; " +
                                "smooth the labels or close their gaps (closing)");
  }
  if (sigma > 0) {
    MeasuredSurface smooth = fitted(remeshed(contour, edge_length), mask, edge_length);
    if (smooth.measures.is_sound()) {
      return smooth;
    }
  }
  MeasuredSurface result = fitted(remeshed(wrapped(contour, edge_length), edge_length), mask, edge_length);
  result.measures.repaired = true;
  return result;
}

}  // namespace

MeasuredSurface extract_surface(const Mask& mask, double edge_length, const std::string& what,
                                const Progress& progress) {
  const double voxel = mask.geometry.spacing.maxCoeff();
  const double first_sigma = std::max(0.6 * voxel, 0.3 * edge_length);
  MeasuredSurface best;
  double edge = edge_length;
  double sigma = first_sigma;
  bool folded = false;
  constexpr int attempts = 5;
  for (int i = 0; i < attempts; ++i) {
    report(progress, static_cast<double>(i) / attempts, "surface of " + what);
    const Surface contour = iso_surface(mask, sigma);
    folded = contour.triangles.rows() > most_triangles;
    if (folded) {
      break;
    }
    MeasuredSurface candidate = fitted(remeshed(contour, edge), mask, edge);
    if (candidate.measures.is_sound()) {
      best = std::move(candidate);
      if (best.measures.within_bounds) {
        return best;
      }
    }
    edge *= 0.7;
    sigma *= i + 2 < attempts ? 0.7 : 0.0;
  }
  if (!best.measures.is_sound()) {
    report(progress, 0.8, "smoothing or wrapping the surface of " + what);
    best = folded ? rescued(mask, edge_length, 2 * first_sigma, what) : rescued(mask, edge, 0, what);
  }
  if (!best.measures.is_sound()) {
    throw std::invalid_argument("no closed surface free of self-intersection could be made of " + what +
                                "; smooth the labels, close their gaps (closing) or use a finer edge length");
  }
  return best;
}

}  // namespace brainshift::segmentation
