// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::segmentation {

/// Falx and tentorium as one sheet of triangles (mm, LPS), which may branch: where cortex or white matter of the left
/// hemisphere faces that of the right one, and where either faces the cerebellum, halfway between them. It ends where
/// anything else joins the parts (corpus callosum, ventricles, deep grey matter, brain stem), and where white matter
/// meets white matter, as in a map that has no number for the corpus callosum. The parts first grow by 10 mm into
/// what has no number of theirs, so the sheet reaches out of the brain by that less half the fissure's width.
/// labels: FreeSurfer's numbers. The sheet is drawn on a grid of 2 mm and smoothed; it lies within a step of the
/// middle. Pieces below 5 cm² are left out. Throws std::invalid_argument when the map lacks the left or the right
/// hemisphere, or they nowhere face each other.
Surface septa_of(const LabelMap& labels);

}  // namespace brainshift::segmentation
