// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipelines/scene/scene.hpp"
#include "segmentation/options/option.hpp"

namespace brainshift::pipelines {

/// An element of the scene and its options. The path names it: "image", "load.simulated" for <load><simulated/></load>,
/// a stage's name for <stage name="...">; an option's path, as in --set, is the element's with the option's name.
struct Element {
  std::string path;
  std::string help;
  bool optional = false;  ///< a part that is not built unless it is named
  std::function<bool(const Scene&)> present;
  std::function<void(Scene&)> add;  ///< makes the part, with defaults; does nothing when it is there
  OptionTable<Scene> options;
};

/// Every element but the tissues and single cuts, in the order in which a scene lists them. The options of a stage are
/// those of the stage's own table. Reading, --set, --defaults, --options, --check, --explain and the stamps of a run
/// come from here.
const std::vector<Element>& scene_elements();

/// The options of a <cut> inside <cuts>; paths "cuts.NUMBER.NAME", counted from 1.
const OptionTable<CutFile>& cut_options();

const Element* find_element(const std::string& path);

}  // namespace brainshift::pipelines
