// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipelines/scene/option.hpp"
#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// An element of the scene and its options. The path names it: "image", "load.simulated" for <load><simulated/></load>,
/// a stage's name for <stage name="...">; an option's path, as in --set, is the element's with the option's name.
struct Element {
  std::string path;
  std::string help;
  bool optional = false;  ///< a part that is not built unless it is named
  std::function<bool(const Scene&)> present;
  std::function<void(Scene&)> add;  ///< makes the part, with defaults; does nothing when it is there
  std::vector<Option<Scene>> options;
};

/// Every element but the tissues and single cuts, in the order in which a scene lists them. The one description of the
/// scene: reading,
/// --set, --defaults, --check, --explain and the stamps of a run come from it.
const std::vector<Element>& scene_elements();

/// The options of a <tissue> inside <tissues>; paths "tissues.LABEL.NAME".
const std::vector<Option<Tissue>>& tissue_options();

/// The options of a <cut> inside <cuts>; paths "cuts.NUMBER.NAME", counted from 1.
const std::vector<Option<CutFile>>& cut_options();

const Element* find_element(const std::string& path);

template <class T>
const Option<T>* find_option(const std::vector<Option<T>>& options, const std::string& name) {
  for (const auto& option : options) {
    if (option.name == name) {
      return &option;
    }
  }
  return nullptr;
}

/// "name, name, name".
template <class T>
std::string option_names(const std::vector<Option<T>>& options) {
  std::string names;
  for (const auto& option : options) {
    names += (names.empty() ? "" : ", ") + option.name;
  }
  return names.empty() ? "none" : names;
}

}  // namespace brainshift::pipelines
