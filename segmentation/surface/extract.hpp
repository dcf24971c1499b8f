// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/mask.hpp"
#include "segmentation/progress/progress.hpp"
#include "segmentation/surface/surface_measures.hpp"

namespace brainshift::segmentation {

/// The half-way surface of a mask smoothed by a Gaussian (sigma, mm; 0: not smoothed), with triangles as small as the
/// voxels, facing outward whatever the image's direction is. No triangle when the smoothing leaves nothing.
Surface iso_surface(const Mask& mask, double sigma);

/// Moves the vertices along their normals, all by one distance, until the surface encloses the volume (mm³).
void fit_volume(Surface& surface, double wanted);

/// 95th percentile over the surface's area of the distance to the faces between voxels inside the mask and outside, mm;
/// not more than 7.5 voxels, as it is not looked for farther.
double boundary_distance_95(const Surface& surface, const Mask& mask);

struct MeasuredSurface {
  Surface surface;
  SurfaceMeasures measures;
};

/// The surface of a mask: smooth, uniform edges, the mask's volume. Starts with the edge length asked for (mm) and goes
/// finer until the volume is within 1 %, 95 % of the surface within 1 mm of the mask's boundary, and no two triangles
/// cut each other. It stops where finer edges would cost much: the best surface so far is taken, or a smoother one, or
/// one that is wrapped; within_bounds then says what was not reached. The mask must not be empty.
/// Throws std::invalid_argument, naming `what` is extracted, when not even that gives a closed surface.
MeasuredSurface extract_surface(const Mask& mask, double edge_length, const std::string& what,
                                const Progress& progress = {});

}  // namespace brainshift::segmentation
