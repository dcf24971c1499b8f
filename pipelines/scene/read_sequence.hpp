// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pipelines/scene/scene.hpp"

namespace tinyxml2 {
class XMLElement;
}

namespace brainshift::pipelines {

/// The elements that a state may change, for messages and help.
std::string changeable_elements();

/// Reads <sequence>, where the scene's root has one, into Scene::states: each state is the one before it, the first the
/// scene, with the elements that it names in place of those that were there. Of tissues it changes the attributes that
/// it names, and what is resected stays out. `scene` is complete but for its states. overrides: of all "path=value"
/// those of a state are "sequence.NAME.path=value". Throws as parse_scene() does.
void read_sequence(const tinyxml2::XMLElement& root, const std::vector<std::string>& overrides, Scene& scene);

/// Whether an override is one of a state.
bool is_of_a_state(std::string_view override);

}  // namespace brainshift::pipelines
