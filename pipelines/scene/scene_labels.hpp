// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipelines/scene/scene.hpp"
#include "segmentation/labels/label_table.hpp"

namespace brainshift::pipelines {

/// How the numbers of a scene's label map are understood.
struct LabelReading {
  bool by_class = false;  ///< by a table: the map then holds the numbers of segmentation::default_label
  std::map<std::uint16_t, std::uint16_t> joined;  ///< else: numbers that a tissue names together, as its first
};
LabelReading label_reading(const Scene& scene);

/// What the labels of the segment stage's map are called: by the scene's tissues, else by segmentation::default_label.
std::map<std::uint16_t, std::string> label_names(const Scene& scene);

/// Whether the label map's classes are known without a tissue for each number: by labels_are, names of segments, or
/// numbers that are unmistakable. Reads the map.
bool classes_are_told(const ImageInputs& image);

/// The map as the stages see it, and what the user should know of it.
struct ReadLabels {
  LabelMap map;
  std::vector<std::string> notes;
};

/// Reads the image's label map, in the order: labels_are, the names of 3D Slicer's segments, FreeSurfer's numbers.
/// Throws std::invalid_argument, naming the file, when its numbers are to be understood by a table and are not those of
/// one, or none of them is parenchyma.
ReadLabels read_labels(const ImageInputs& image, const LabelReading& reading);

}  // namespace brainshift::pipelines
