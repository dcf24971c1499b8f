// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/scene_labels.hpp"

#include <algorithm>

#include "segmentation/files/refuse.hpp"

namespace brainshift::pipelines {
namespace {

namespace sg = segmentation;

std::string numbers_of(const sg::LabelVolumes& volumes) {
  constexpr std::size_t most = 20;
  std::string text;
  std::size_t count = 0;
  for (const auto& [number, volume] : volumes) {
    if (++count > most) {
      return text + " and others";
    }
    text += (text.empty() ? "" : " ") + std::to_string(number);
  }
  return text.empty() ? "none" : text;
}

sg::LabelTable table_of(const ImageInputs& image, const sg::LabelVolumes& volumes, std::vector<std::string>& notes) {
  const std::string file = image.labels.string();
  if (!image.labels_are.empty()) {
    return sg::find_label_table(image.labels_are);
  }
  if (!sg::is_freesurfer(volumes)) {
    refuse(image.labels, "its numbers (" + numbers_of(volumes) +
                             ") are not FreeSurfer's, and the scene has no <tissues>; say what they are, by "
                             "labels_are=\"freesurfer\" or a table's file, or name a <tissue> for each");
  }
  notes.push_back(file + ": the numbers are taken for FreeSurfer's; if they are others, say so by labels_are");
  return sg::freesurfer_table();
}

void check_classes(const ImageInputs& image, const sg::LabelTable& table, const LabelMap& map,
                   std::vector<std::string>& notes) {
  const auto volumes = sg::label_volumes(map);
  if (!volumes.contains(sg::default_label::parenchyma)) {
    refuse(
        image.labels,
        "no voxel is brain, when its numbers are " + table.name + "; correct labels_are" +
            (volumes.contains(sg::default_label::tumour) ? ", or give this map as tumour= beside a brain_mask" : ""));
  }
  if (!volumes.contains(sg::default_label::ventricles)) {
    notes.push_back(image.labels.string() + ": has no ventricles, so the brain is parenchyma throughout");
  }
}

}  // namespace

LabelReading label_reading(const Scene& scene) {
  LabelReading reading;
  reading.by_class =
      !scene.image.labels.empty() && std::none_of(scene.tissues.begin(), scene.tissues.end(),
                                                  [](const Tissue& tissue) { return tissue.tissue_class == 0; });
  for (const Tissue& tissue : scene.tissues) {
    for (const std::int16_t number : tissue.labels) {
      reading.joined[number] = tissue.label;
    }
  }
  return reading;
}

ReadLabels read_labels(const ImageInputs& image, const LabelReading& reading) {
  ReadLabels result{read_label_map(image.labels), {}};
  if (!reading.by_class) {
    sg::renumber(result.map, reading.joined, sg::Unnamed::stay);
    return result;
  }
  const auto volumes = sg::label_volumes(result.map);
  const sg::LabelTable table = table_of(image, volumes, result.notes);
  if (const std::string unknown = unknown_labels(volumes, table); !unknown.empty()) {
    result.notes.push_back(image.labels.string() + ": taken for not brain, as they are not " + table.name +
                           " numbers of the brain: " + unknown);
  }
  sg::renumber(result.map, table.classes, sg::Unnamed::become_background);
  check_classes(image, table, result.map, result.notes);
  return result;
}

}  // namespace brainshift::pipelines
