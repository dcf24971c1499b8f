// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "register/field/brain_zones.hpp"
#include "segmentation/geometry/points.hpp"
#include "segmentation/image/image.hpp"
#include "segmentation/progress/progress.hpp"
#include "solve/interface/solution.hpp"

namespace brainshift::registration {

/// The displacement of every voxel of a grid, mm, LPS. In the brain u(x) = Σφ_a(x) û_a with the solver's own shape
/// functions, and a little farther (by a voxel's diagonal or 0.3 of the nodes' spacing), so that places on the surface
/// between voxels move as they did in the solver. Beyond, the displacement at the end of that way out from the surface,
/// times a ramp of the distance with a continuous slope, from 1 there to 0 at the fade. In a cavity, farther from its
/// wall than that way, the displacement is spanned from wall to wall, span_cavity(). Throws std::invalid_argument
/// when the solution's shape functions do not reach a voxel of the brain.
VectorImage forward_field(const Solution& solution, const BrainZones& zones, const ImageGeometry& geometry, double fade,
                          const Progress& progress);

/// The solver's displacement at places, (m × 3) mm.
using DisplacementAt = std::function<Points(const Points& places)>;

/// Where the fading voxels of one grid take their displacement from.
struct WayOut {
  std::vector<Eigen::Vector3d> places;  ///< indices of the grid
};

/// The same of a displacement that is asked for at all places in the brain and near it, part by part: for the same
/// zones and grid at the same places in the same order. spacing: mean of the nodes', mm. way: of an earlier field of
/// the same zones and grid, or empty, then it is noted; null: not kept.
VectorImage forward_field(const DisplacementAt& displacement_at, double spacing, const BrainZones& zones,
                          const ImageGeometry& geometry, double fade, const Progress& progress, WayOut* way = nullptr);

}  // namespace brainshift::registration
