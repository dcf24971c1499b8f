// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/check_tissues.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

#include "pipelines/scene/scene_fault.hpp"
#include "pipelines/scene/scene_labels.hpp"
#include "segmentation/labels/label_table.hpp"
#include "solve/material/check_material.hpp"

namespace brainshift::pipelines {
namespace {

std::set<std::uint16_t> labels_in(const LabelMap& map) {
  std::set<std::uint16_t> labels;
  for (const auto& [label, volume] : segmentation::label_volumes(map)) {
    labels.insert(label);
  }
  return labels;
}

/// A tumour of its own file gets this number, which another tissue must not have.
void check_is_free(std::uint16_t tumour, const std::set<std::uint16_t>& labels, const Scene& scene) {
  const auto& others = scene.image.other_labels;
  const std::string place = scene.image.tumour.empty() ? "image.tumour_mask" : "image.tumour";
  const std::string number = std::to_string(tumour);
  if (std::find(others.begin(), others.end(), tumour) != others.end()) {
    fail(scene, place,
         "the tumour becomes label " + number + ", which other_labels says is not of the brain; take it out there");
  }
  const bool is_one = std::any_of(scene.tissues.begin(), scene.tissues.end(), [&](const Tissue& tissue) {
    return tissue.label == tumour &&
           (tissue.named_material == "tumour" || segmentation::class_of_name(tissue.name) == tumour);
  });
  if (labels.contains(tumour) && !is_one) {
    fail(scene, place,
         "the tumour becomes label " + number + ", which " + scene.image.labels.string() +
             " has already; give that tissue another number, or name it \"tumour\" if it is one");
  }
}

/// The labels that the segment stage will give: of the map, with the numbers that tissues join, of the classes, or
/// tissue 1 of a bare surface.
std::set<std::uint16_t> labels_to_come(const Scene& scene) {
  namespace label = segmentation::default_label;
  std::set<std::uint16_t> labels = {label::parenchyma};
  if (!scene.image.labels.empty()) {
    labels = labels_in(read_labels(scene.image, label_reading(scene)).map);
  } else if (!scene.image.brain_mask.empty()) {
    labels.insert({label::ventricles, label::csf});
  }
  if (!scene.image.tumour_mask.empty() || !scene.image.tumour.empty()) {
    check_is_free(label::tumour, labels, scene);
    labels.insert(label::tumour);
  }
  return labels;
}

std::string listed(const std::set<std::uint16_t>& labels) {
  return labels.empty() ? "none" : write_numbers(labels);
}

bool by_class(const Tissue& tissue) {
  return tissue.tissue_class != 0;
}

/// Whether Young's modulus was written beside or after what gives a tissue its law: the command line may change the law
/// of a tissue that had one, and so may a state, whose others may use it.
bool modulus_is_last(const Scene& scene, const std::string& tissue) {
  const auto order_of = [&](const char* name) {
    const auto found = scene.source.lines.find(tissue + name);
    const bool by_command = found != scene.source.lines.end() && found->second == 0;
    return found == scene.source.lines.end() ? 0 : by_command ? std::numeric_limits<int>::max() : found->second;
  };
  const int modulus = order_of(".youngs_modulus");
  return !scene.state && modulus > 0 && modulus >= std::max(order_of(".law"), order_of(".material"));
}

/// Of tissues named by class.
void check_classes(const Scene& scene) {
  if (!std::all_of(scene.tissues.begin(), scene.tissues.end(), by_class)) {
    fail(scene, "tissues", "some tissues are named by class, others by label; name all of them in one way");
  }
  if (!scene.image.labels.empty()) {
    check_at(scene, "image.labels", [&] { read_labels(scene.image, label_reading(scene)); });
  }
}

}  // namespace

void check_tissues(const Scene& scene) {
  if (scene.tissues.empty()) {
    fail(scene, "tissues", "the scene has no <tissues>; name a tissue with its material for each label of the brain");
  }
  for (const Tissue& tissue : scene.tissues) {
    const std::string place = "tissues." + std::to_string(tissue.label);
    check_at(scene, place, [&] { check_material(tissue); });
    if (tissue.material.law == solve::Law::ogden && modulus_is_last(scene, place)) {
      fail(scene, place + ".youngs_modulus",
           place + " follows the law ogden, whose stiffness is in its terms, so that youngs_modulus would change " +
               "nothing; leave it out, or set law to another");
    }
  }
  if (!is_ours(scene, StageId::segment)) {
    return;
  }
  if (std::any_of(scene.tissues.begin(), scene.tissues.end(), by_class)) {
    check_classes(scene);
    return;
  }
  const std::set<std::uint16_t> labels = labels_to_come(scene);
  const bool lists = std::any_of(scene.tissues.begin(), scene.tissues.end(),
                                 [](const Tissue& tissue) { return !tissue.labels.empty(); });
  const std::string source = scene.image.labels.empty() ? "the segmentation" : scene.image.labels.string();
  std::set<std::uint16_t> named(scene.image.other_labels.begin(), scene.image.other_labels.end());
  for (const Tissue& tissue : scene.tissues) {
    if (!labels.contains(tissue.label)) {
      fail(scene, "tissues." + std::to_string(tissue.label),
           "tissue " + std::to_string(tissue.label) + " is not in " + source + ", whose labels are " + listed(labels) +
               "; remove the tissue or correct its label");
    }
    named.insert(tissue.label);
  }
  for (const std::uint16_t label : labels) {
    if (!named.contains(label) && !lists) {
      fail(
          scene, "tissues",
          "label " + std::to_string(label) + " of " + source +
              " has no material; give it a <tissue>, or list it in the image's other_labels if it is not of the brain");
    }
  }
  const auto skull = scene.image.skull_label;
  if (skull && !labels.contains(*skull)) {
    fail(scene, "image.skull_label",
         "skull_label " + std::to_string(*skull) + " is not in " + source + ", whose labels are " + listed(labels));
  }
}

void check_material(const Tissue& tissue) {
  solve::check_material("the material of label " + std::to_string(tissue.label), tissue.material);
}

}  // namespace brainshift::pipelines
