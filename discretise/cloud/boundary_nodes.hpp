// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "discretise/body/scanlines.hpp"
#include "discretise/interface/options.hpp"
#include "discretise/sizing/sizing_field.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::discretise {

/// Where tissues meet that are not alike: the centres of the voxels' faces there, each moved to the mean of those about
/// it, which takes the steps of the voxels out; mm. Empty without labels.
Points smooth_tissue_boundary(const LabelMap* labels, const DiscretiseOptions& options);

/// Moves the nodes that are nearest to a boundary onto it, so that strain may jump there: those within 0.45 of their
/// spacing. One that would come nearer than half a spacing to a node there, or to one of `fixed`, goes; one whose place
/// lies outside the body stays where it is. nodes: on return those that were moved come first.
/// boundary: places on it, dense. spacing: the uniform one, mm. Returns how many were moved.
std::size_t move_onto_boundary(const Points& boundary, const Points& fixed, const Scanlines& body,
                               const SizingField& sizing, double spacing, Points& nodes);

}  // namespace brainshift::discretise
