// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "segmentation/image/segments.hpp"

namespace brainshift::segmentation {

/// The segments of a 3D Slicer's file laid over each other, and what the user should know of it, a sentence each.
struct Overlaid {
  LabelMap map;
  std::vector<std::string> notes;
};

/// Whether there are segments and each has a name that tells what it is; "Segment_1" does not.
bool names_tell(std::span<const Segment> segments);

/// The file as classes of default_label, by the segments' names (class_of_name()). Where segments overlap tumour lies
/// over ventricles, these over fluid, brain, skull and what is not brain, in this order; of one class the later
/// segment. Throws std::invalid_argument, naming the file, as read_layers() does.
Overlaid read_by_names(const std::filesystem::path& file);

/// The file with its own numbers, overlaid by the same order; any other label map as read_label_map() reads it. Throws
/// when two segments have one number in different layers, too.
Overlaid read_by_numbers(const std::filesystem::path& file);

}  // namespace brainshift::segmentation
