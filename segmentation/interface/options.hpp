// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace brainshift::segmentation {

/// What a label of the label map is. The numbers are the user's; these are the ones that classify() and the phantom
/// write.
namespace default_label {
inline constexpr std::uint16_t parenchyma = 1;
inline constexpr std::uint16_t ventricles = 2;
inline constexpr std::uint16_t tumour = 3;
inline constexpr std::uint16_t csf = 4;
inline constexpr std::uint16_t skull = 5;
inline constexpr std::uint16_t skin = 6;
}  // namespace default_label

/// What each may be stands in option_table.cpp.
struct SegmentOptions {
  double edge_length = 5.0;       ///< target edge of the remeshed surfaces, mm
  int classes = 3;                ///< fuzzy c-means classes (CSF, grey, white)
  double ventricle_depth = 15.0;  ///< CSF is ventricle where most of its body lies this deep in the brain, mm
  std::optional<double> closing;  ///< gaps of the brain narrower than twice this are closed, mm; absent: none
  bool tissue_surfaces = false;   ///< whether each tissue gets a surface of its own
  std::vector<std::uint16_t> brain_labels = {default_label::parenchyma, default_label::ventricles,
                                             default_label::tumour};
  std::optional<std::uint16_t>
      skull_label;  ///< absent: the skull's inner surface is the fluid's or the brain's outer one
  std::optional<std::uint16_t> fluid_label;  ///< around the brain: where it surrounds it, the skull is behind it
};

}  // namespace brainshift::segmentation
