// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/tissue_table.hpp"

#include "segmentation/labels/label_table.hpp"
#include "solve/material/material_options.hpp"
#include "solve/material/named_materials.hpp"

namespace brainshift::pipelines {
namespace {

/// Sets law and all constants; those that come after it override them.
Option<Tissue> material_option() {
  Option<Tissue> option = text_option<Tissue>("material", &Tissue::named_material,
                                              "law and constants from the literature; others beside it override them");
  option.allowed.clear();
  for (const std::string& name : solve::material_names()) {
    option.allowed += name + " | ";
  }
  option.allowed += "nothing";
  option.read = [](Tissue& tissue, const std::string& name) {
    const auto material = solve::named_material(name);
    if (material) {
      tissue.material = *material;
    }
    if (material || name.empty()) {
      tissue.named_material = name;
    }
    return material || name.empty();
  };
  return option;
}

detail::NamedValues<std::uint16_t> tissue_classes() {
  detail::NamedValues<std::uint16_t> classes = {{"none", std::uint16_t{0}}};
  for (const auto& [number, name] : segmentation::brain_classes) {
    classes.emplace_back(name, number);
  }
  return classes;
}

Option<Tissue> label_option() {
  Option<Tissue> option = number_option<Tissue>("label", &Tissue::label, label_numbers, "",
                                                "in the label map; a tissue has a label, labels or a class");
  option.get = [](const Tissue& tissue) { return tissue.label == 0 ? "" : std::to_string(tissue.label); };
  return option;
}

OptionTable<Tissue> make_tissue_options() {
  OptionTable<Tissue> options = {
      label_option(),
      label_ranges_option<Tissue>("labels", &Tissue::labels,
                                  "in the label map, joined to the first of them; labels that no tissue lists are then "
                                  "not brain"),
      choice_option<Tissue>("class", &Tissue::tissue_class, tissue_classes(),
                            "in place of labels, where labels_are tells them, they are recognised, or the T1 is "
                            "classified; a class that is not named has its usual material"),
      text_option<Tissue>("name", &Tissue::name, "for people"), material_option()};
  append(options, of_whole<Tissue>(solve::material_options(), &Tissue::material));
  return options;
}

}  // namespace

const OptionTable<Tissue>& tissue_options() {
  static const OptionTable<Tissue> options = make_tissue_options();
  return options;
}

std::string usual_material(std::uint16_t tissue_class) {
  namespace label = segmentation::default_label;
  return tissue_class == label::ventricles ? "ventricle" : tissue_class == label::tumour ? "tumour" : "brain";
}

bool names_tissue(const std::string& option) {
  return option == "label" || option == "labels" || option == "class";
}

}  // namespace brainshift::pipelines
