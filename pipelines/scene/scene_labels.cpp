// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/scene_labels.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <span>

#include "segmentation/files/refuse.hpp"
#include "segmentation/labels/segmentation_file.hpp"

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
                             "labels_are=\"freesurfer\" or a table's file, by the names of 3D Slicer's segments, or "
                             "name a <tissue> for each");
  }
  notes.push_back(file + ": the numbers are taken for FreeSurfer's; if they are others, say so by labels_are");
  return sg::freesurfer_table();
}

// Where no number is fluid or skull, what is labelled and not brain may still say where the skull is: it stays in the
// map, as skin.
sg::LabelTable with_outer_labels(sg::LabelTable table, const sg::LabelVolumes& volumes) {
  namespace label = sg::default_label;
  const auto class_of = [&table](std::uint16_t number) {
    const auto found = table.classes.find(number);
    return found == table.classes.end() ? std::uint16_t{0} : found->second;
  };
  if (std::none_of(volumes.begin(), volumes.end(), [&](const auto& found) {
        return class_of(found.first) == label::csf || class_of(found.first) == label::skull;
      })) {
    for (const auto& [number, volume] : volumes) {
      table.classes[number] = class_of(number) == 0 ? label::skin : class_of(number);
    }
  }
  return table;
}

// What a table's file makes of the map's numbers: "parenchyma 1 7, ventricles 4".
std::string classes_of(const sg::LabelVolumes& volumes, const sg::LabelTable& table) {
  std::string text;
  for (const auto& [tissue, name] : sg::classes_in_skull) {
    sg::LabelVolumes of_class;
    for (const auto& [number, volume] : volumes) {
      if (const auto found = table.classes.find(number); found != table.classes.end() && found->second == tissue) {
        of_class.emplace(number, volume);
      }
    }
    text += of_class.empty() ? "" : (text.empty() ? "" : ", ") + std::string(name) + " " + numbers_of(of_class);
  }
  return text;
}

// Of FreeSurfer's numbers for cortex and white matter: 1 left, 2 right, 0 any other. 1000, 3000, 5001 and 11100 are
// left; 2000, 4000, 5002 and 12100 right.
int side_of(int number) {
  if (number == 2 || number == 3) {
    return 1;
  }
  if (number == 41 || number == 42) {
    return 2;
  }
  const int odd = number / 1000 == 5 ? number : number / 1000;
  return number < 1000 ? 0 : odd % 2 == 1 ? 1 : 2;
}

// Whether the voxels of a side are half a brain: its standard deviation along its thinnest direction is 0.33 to 0.41 of
// that along its longest in either half of nine heads, 0.50 to 0.62 in the whole.
bool is_half(const LabelMap& labels, int side) {
  constexpr double between = 0.45;
  double count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  const Eigen::Array3i size = labels.geometry.size;
  for (int k = 0; k < size.z(); ++k) {
    for (int j = 0; j < size.y(); ++j) {
      for (int i = 0; i < size.x(); ++i) {
        if (side_of(labels.at(i, j, k)) == side) {
          const Eigen::Vector3d place = Eigen::Array3d(i, j, k) * labels.geometry.spacing.array();
          ++count;
          sum += place;
          squares += place * place.transpose();
        }
      }
    }
  }
  const Eigen::Matrix3d covariance = squares / count - sum / count * (sum / count).transpose();
  const Eigen::Vector3d widths = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues();
  return widths[0] < between * between * widths[2];
}

// Of FreeSurfer's numbers: a hemisphere that is missing. Where left and right were given the same numbers, none is.
void note_one_sided(const ImageInputs& image, const LabelMap& labels, const sg::LabelVolumes& volumes,
                    std::vector<std::string>& notes) {
  double left = 0, right = 0;
  for (const auto& [number, volume] : volumes) {
    left += side_of(number) == 1 ? volume : 0;
    right += side_of(number) == 2 ? volume : 0;
  }
  if (std::min(left, right) < 0.2 * std::max(left, right) && is_half(labels, left < right ? 2 : 1)) {
    notes.push_back("warning: " + image.labels.string() + ": of the " + (left < right ? "left" : "right") +
                    " hemisphere hardly anything is labelled, and it is taken for no brain; give a map of both, unless "
                    "that is meant");
  }
}

// when: the classes are these, and what to do where they are not.
void check_classes(const ImageInputs& image, const std::string& when, const LabelMap& map,
                   std::vector<std::string>& notes) {
  const auto volumes = sg::label_volumes(map);
  if (!volumes.contains(sg::default_label::parenchyma)) {
    refuse(
        image.labels,
        "no voxel is brain, when its " + when +
            (volumes.contains(sg::default_label::tumour) ? ", or give this map as tumour= beside a brain_mask" : ""));
  }
  if (!volumes.contains(sg::default_label::ventricles)) {
    notes.push_back(image.labels.string() + ": has no ventricles, so the brain is parenchyma throughout");
  }
}

std::string within_brain(const ImageInputs& image, std::uint16_t number, const sg::LabelVolumes& volumes) {
  return "warning: " + image.labels.string() + ": label " + std::to_string(number) + " (" +
         sg::in_millilitres(volumes.at(number)) + ") lies within the brain, ";
}

// Of tissues that list numbers: those of the map that none does.
void note_unlisted(const ImageInputs& image, const LabelReading& reading, ReadLabels& read) {
  if (reading.joined.empty()) {
    return;
  }
  std::map<std::uint16_t, std::uint16_t> named = reading.joined;
  for (const std::uint16_t number : image.other_labels) {
    named.emplace(number, number);
  }
  if (image.skull_label) {
    named.emplace(*image.skull_label, *image.skull_label);
  }
  const auto volumes = sg::label_volumes(read.map);
  if (const std::string unlisted = sg::unknown_labels(volumes, {"", named}); !unlisted.empty()) {
    read.notes.push_back(image.labels.string() + ": taken for not brain, as no tissue lists them: " + unlisted);
  }
  for (const std::uint16_t number : sg::enclosed_labels(read.map, reading.joined)) {
    if (!named.contains(number)) {
      read.notes.push_back(
          within_brain(image, number, volumes) +
          "but no tissue lists it, and it counts as the tissue about it; list it in a tissue, or in other_labels if it "
          "is not of the brain");
    }
  }
}

// Of numbers that a table lacks: what lies within the brain becomes brain, what lies outside does not.
void note_unknown(const ImageInputs& image, const sg::LabelTable& table, sg::LabelVolumes volumes, ReadLabels& read) {
  namespace label = sg::default_label;
  constexpr double worth_saying = 1000;  // mm³
  std::map<std::uint16_t, std::uint16_t> brain = table.classes;
  std::erase_if(brain, [](const auto& entry) { return entry.second == label::csf || entry.second == label::skull; });
  for (const std::uint16_t number : sg::enclosed_labels(read.map, brain)) {
    if (!table.classes.contains(number) && volumes.at(number) >= worth_saying) {
      read.notes.push_back(within_brain(image, number, volumes) + "but is not among " + table.name +
                           ", and it counts as the tissue about it; give it the number of a tissue if it is another");
      volumes.erase(number);
    }
  }
  if (const std::string unknown = sg::unknown_labels(volumes, table); !unknown.empty()) {
    read.notes.push_back(image.labels.string() +
                         ": taken for not brain where the brain does not enclose them, as they are not among " +
                         table.name + ": " + unknown);
  }
}

// Segments of 3D Slicer, whose names are taken unless the user says what the numbers are.
bool are_named(const ImageInputs& image) {
  return image.labels_are.empty() && sg::names_tell(read_segments(image.labels));
}

}  // namespace

std::map<std::uint16_t, std::string> label_names(const Scene& scene) {
  std::map<std::uint16_t, std::string> names;
  for (const auto& [number, name] : std::span(sg::label_classes).subspan(sg::brain_classes.size())) {
    names[number] = name;
  }
  const bool own_numbers = !scene.image.labels.empty() && !label_reading(scene).by_class;
  if (own_numbers) {
    // What is not of the brain has its usual meaning only where the scene leaves it at that.
    names = scene.source.lines.contains("image.other_labels") ? decltype(names){} : names;
    if (scene.image.skull_label) {
      names[*scene.image.skull_label] = "skull";
    }
  } else {
    for (const auto& [number, name] : sg::brain_classes) {
      names[number] = name;
    }
  }
  for (const Tissue& tissue : scene.tissues) {
    if (own_numbers) {
      names.erase(tissue.label);
    }
    const std::string& name = tissue.name.empty() && own_numbers ? tissue.named_material : tissue.name;
    if (!name.empty()) {
      names[tissue.label] = name;
    }
  }
  return names;
}

LabelReading label_reading(const Scene& scene) {
  LabelReading reading;
  reading.by_class =
      !scene.image.labels.empty() && std::none_of(scene.tissues.begin(), scene.tissues.end(),
                                                  [](const Tissue& tissue) { return tissue.tissue_class == 0; });
  for (const Tissue& tissue : scene.tissues) {
    for (const std::uint16_t number : tissue.labels) {
      reading.joined[number] = tissue.label;
    }
  }
  for (const Tissue& tissue : scene.tissues) {
    if (!reading.joined.empty() && tissue.labels.empty()) {
      reading.joined[tissue.label] = tissue.label;
    }
  }
  return reading;
}

bool classes_are_told(const ImageInputs& image) {
  return !image.labels_are.empty() || are_named(image) ||
         sg::is_freesurfer(sg::label_volumes(sg::read_by_numbers(image.labels).map));
}

ReadLabels read_labels(const ImageInputs& image, const LabelReading& reading) {
  if (reading.by_class && are_named(image)) {
    auto [map, notes] = sg::read_by_names(image.labels);
    check_classes(image, "segments are what their names say; rename them in 3D Slicer", map, notes);
    return {std::move(map), std::move(notes)};
  }
  auto [map, notes] = sg::read_by_numbers(image.labels);
  ReadLabels result{std::move(map), std::move(notes)};
  if (!reading.by_class) {
    note_unlisted(image, reading, result);
    sg::renumber(result.map, reading.joined, sg::Unnamed::stay);
    return result;
  }
  const auto volumes = sg::label_volumes(result.map);
  const sg::LabelTable table = table_of(image, volumes, result.notes);
  note_unknown(image, table, volumes, result);
  if (table.name == sg::freesurfer_table().name) {
    note_one_sided(image, result.map, volumes, result.notes);
  } else if (table.name != sg::brats_table().name) {
    result.notes.push_back(image.labels.string() + ": its numbers are " + classes_of(volumes, table) +
                           ", by the names in " + image.labels_are);
  }
  sg::renumber(result.map, with_outer_labels(table, volumes).classes, sg::Unnamed::become_background);
  check_classes(image, "numbers are " + table.name + "; correct labels_are", result.map, result.notes);
  return result;
}

}  // namespace brainshift::pipelines
