// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "segmentation/image/image.hpp"

namespace brainshift {

/// A segment of 3D Slicer: the voxels of one layer that hold one number.
struct Segment {
  std::string name;
  std::uint16_t label = 1;
  std::size_t layer = 0;
};

/// The segments that the header of a .nrrd names (3D Slicer's .seg.nrrd), in its order; none of any other file. Throws
/// std::invalid_argument, naming the file, when the header cannot be, a segment lies in a layer that is not there, or
/// the voxels hold shares instead of numbers.
std::vector<Segment> read_segments(const std::filesystem::path& file);

/// The layers of such a file, all of one grid: more than one where segments overlap. Throws as read_label_map() does.
std::vector<LabelMap> read_layers(const std::filesystem::path& file);

}  // namespace brainshift
