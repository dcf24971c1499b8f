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
/// functions, and a little farther (by a voxel's diagonal or 0.3 of the nodes' least spacing), so that places on the
/// surface between voxels move as they did in the solver. Beyond, the displacement at the end of that way out from the
/// surface, times a ramp of the distance with a continuous slope, from 1 there to 0 at the fade. In a cavity, farther
/// from its wall than that way, the displacement is spanned from wall to wall, span_cavity(). Throws
/// std::invalid_argument when the solution's shape functions do not reach a voxel of the brain.
VectorImage forward_field(const Solution& solution, const BrainZones& zones, const ImageGeometry& geometry, double fade,
                          const Progress& progress);

/// The solver's displacement at places, (m × 3) mm.
using DisplacementAt = std::function<Points(const Points& places)>;

struct FieldVoxel {
  int i, j, k;
  std::size_t offset;
  Eigen::Vector3d index() const { return {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}; }
};

/// Voxels that follow each other along x.
struct FieldRun {
  std::size_t first, count;  ///< in the list of voxels
  bool inner;                ///< all their neighbours count
};

/// What of a field on one grid does not depend on the displacement. Voxels are in the order of their offsets.
struct FieldPlan {
  std::vector<FieldVoxel> inside;           ///< in the brain and near it: the displacement is the solver's
  std::vector<FieldVoxel> fading;           ///< take the displacement of the brain near by
  std::vector<Eigen::Vector3d> taken_from;  ///< where each of those does, index of the grid
  std::vector<FieldVoxel> outside;          ///< are smoothed and fade
  std::vector<FieldRun> runs;               ///< of those
  std::vector<double> distance;             ///< of each of those from the brain, mm
};

/// The same of a displacement that is asked for at all places in the brain and near it, part by part: for the same
/// zones and grid at the same places in the same order. spacing: least of the nodes', mm. plan: of an earlier field of
/// the same zones, grid and spacing, for which the places are not told again, but a row each; or empty, then it is
/// noted; null: not kept.
VectorImage forward_field(const DisplacementAt& displacement_at, double spacing, const BrainZones& zones,
                          const ImageGeometry& geometry, double fade, const Progress& progress,
                          FieldPlan* plan = nullptr);

}  // namespace brainshift::registration
