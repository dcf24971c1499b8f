// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/cut/walled_resection.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/quadrature/adaptive_points.hpp"

namespace brainshift::solve {

/// Takes Model::resection out: within its wall, or by its labels where that is unknown. Then the wall of the cavity is
/// where the labels of integration points change. A node goes when the point nearest to it goes and none that stays
/// lies within three quarters of its spacing; one that stays is on_surface when a point within its spacing goes. The
/// pressure is among the forces at the nodes, on the wall as it is undeformed. Throws std::invalid_argument, saying
/// which, when there is no such label, nothing is left, or a node that goes has a prescribed displacement or a force.
Resected resect(const Model& model, const SolveOptions& options);

/// Leaves out points, and their rows, of the tissue that is taken out by its labels.
void leave_out(const Resection& resection, AdaptivePoints& placed);

/// What a label map can say of a point: the labels with a material, and those that are taken out where their voxels say
/// which points go. Beside a wall a voxel of theirs says nothing.
std::vector<std::int32_t> tissues_of(const Model& model);

}  // namespace brainshift::solve
