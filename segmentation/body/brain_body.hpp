// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "segmentation/image/mask.hpp"
#include "segmentation/interface/options.hpp"

namespace brainshift::segmentation {

/// The part of a body's surface on the image's border.
struct BorderCut {
  double area = 0;   ///< mm²
  bool off = false;  ///< whether the border cuts the body off rather than that the body ends there
};
/// beyond: counts only where this grid goes on beyond the border, as a T1 does that shows more than a map of its
/// labels.
BorderCut border_cut(const Mask& body, const ImageGeometry* beyond = nullptr);

/// What the user should know of it, the border so called; empty where nothing lies on it.
std::string cut_sentence(const BorderCut& cut, const std::string& border);

/// The brain as one body without holes.
struct BrainBody {
  Mask mask;
  double across = 0;        ///< the longest edge of the box around it, along the image's axes, mm
  double loose_volume = 0;  ///< of tissue that hangs together with none of it and was dropped, mm³
  std::size_t loose_pieces = 0;
  double hole_volume = 0;  ///< of holes of 1 ml and more in the tissue, mm³
  BorderCut cut;
};

/// The largest piece of the tissue, its sulci closed where they are narrower than twice the radius (mm; 0: not closed),
/// holes filled. Throws std::invalid_argument when there is none, it is not of a brain's size, or a fifth of its
/// surface lies on the image's border.
BrainBody brain_body(const Mask& tissue, double closing);

/// Throws std::invalid_argument, with the advice, unless a brain can be so many mm across.
void check_across(double across, const std::string& advice);

/// Throws std::invalid_argument where the edges of a surface (mm) would be longer than the default and than a sixth of
/// the brain, which is so many mm across.
void check_edge_length(double edge_length, double across);

/// Whether the skull's label encloses the brain.
bool encloses(const LabelMap& labels, std::uint16_t skull, const Mask& brain);

/// What lies within the skull's label: its own inner surface bounds it. Throws std::invalid_argument when no voxel
/// carries it, or it does not enclose the brain.
Mask skull_cavity(const LabelMap& labels, std::uint16_t skull, const Mask& brain);

/// The brain with the fluid around it, as far as `reach` (mm) from the brain. Empty (no voxels) where fluid touches
/// less than half of the brain's surface: then it does not say where the skull is.
Mask fluid_space(const LabelMap& labels, std::uint16_t fluid, const Mask& brain, double reach);

/// The space around the brain that a label outside it bounds: what can be reached from the brain without crossing the
/// label, not farther than `reach` (mm). Empty (no voxels) where the label bounds less than 4/5 of that: then it has
/// gaps, or is skin, farther off than a skull.
Mask bounded_space(const LabelMap& labels, std::uint16_t outer, const Mask& brain, double reach);

}  // namespace brainshift::segmentation
