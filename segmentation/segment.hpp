// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/image/image.hpp"
#include "segmentation/progress.hpp"
#include "segmentation/surface/surface.hpp"
#include "segmentation/surface/surface_measures.hpp"

namespace brainshift::segmentation {

/// What a label of the label map is. The numbers are the user's; these are the ones that classify() and the phantom
/// write.
namespace default_label {
inline constexpr std::int16_t parenchyma = 1;
inline constexpr std::int16_t ventricles = 2;
inline constexpr std::int16_t tumour = 3;
inline constexpr std::int16_t csf = 4;
inline constexpr std::int16_t skull = 5;
inline constexpr std::int16_t skin = 6;
}  // namespace default_label

struct SegmentOptions {
  double edge_length = 5.0;       ///< target edge of the remeshed surfaces, mm
  int classes = 3;                ///< fuzzy c-means classes (CSF, grey, white), at least 2
  double ventricle_depth = 15.0;  ///< CSF is ventricle where most of its body lies this deep in the brain, mm
  std::vector<std::int16_t> brain_labels = {default_label::parenchyma, default_label::ventricles,
                                            default_label::tumour};
  std::optional<std::int16_t> skull_label;  ///< absent: the skull's inner surface is the brain's outer one
};

/// What goes in: labels, or a T1 with a brain mask, or a brain surface (possibly broken). Exactly one of them; a T1 may
/// come with labels (only its geometry is compared) and a tumour mask with labels or mask (it becomes label 3).
struct SegmentInput {
  std::optional<ScalarImage> t1;
  std::optional<LabelMap> labels;
  std::optional<LabelMap> brain_mask;   ///< non-zero is brain
  std::optional<LabelMap> tumour_mask;  ///< non-zero is tumour
  std::optional<Surface> surface;
};

struct Segmentation {
  std::optional<LabelMap> labels;        ///< as given or classified; absent when only a surface came in
  std::vector<ScalarImage> memberships;  ///< one a class, darkest first; empty unless classified
  Surface brain;                         ///< the union of the brain's tissues, holes filled, largest component
  Surface skull;  ///< inner surface of the skull, outward oriented like the others (the brain lies inside)
  std::map<std::int16_t, Surface> tissues;          ///< one a brain label
  std::map<std::string, SurfaceMeasures> measures;  ///< "brain", "skull", "tissue_<label>"
};

/// Makes a surface from outside fit for the other stages: turned outward where it is closed and free of
/// self-intersection, else wrapped (counted as repaired), then remeshed to edge_length (mm).
/// Throws std::invalid_argument when nothing closed comes out, or the wrap fills or loses most of it.
struct CheckedSurface {
  Surface surface;
  SurfaceMeasures measures;
};
CheckedSurface checked_surface(const Surface& surface, double edge_length);

/// Writes labels.nii.gz, brain.vtp, skull.vtp, tissue_<label>.vtp and membership_<class>.nii.gz (class 0 is the
/// darkest) into a folder, which is made if need be. Throws std::runtime_error when a file cannot be written whole.
void write_segmentation(const std::filesystem::path& folder, const Segmentation& segmentation);

/// Runs the stage. Throws std::invalid_argument when the input cannot be used (what, why, what to do).
Segmentation segment(const SegmentInput& input, const SegmentOptions& options, const Progress& progress = {});

}  // namespace brainshift::segmentation
