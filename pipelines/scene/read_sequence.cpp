// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/read_sequence.hpp"

#include <algorithm>
#include <array>

#include "pipelines/scene/read_elements.hpp"

namespace brainshift::pipelines {
namespace {

struct Changeable {
  const char* path;
  void (*forget)(Scene&);  ///< what was there of it; nothing of what a state adds to
};

constexpr std::array changeable = {Changeable{"load", [](Scene& scene) { scene.load.reset(); }},
                                   Changeable{"gravity", [](Scene& scene) { scene.gravity.reset(); }},
                                   Changeable{"cuts", [](Scene& scene) { scene.cuts.reset(); }},
                                   Changeable{"resection", [](Scene& scene) { scene.resection.reset(); }},
                                   Changeable{"tissues", [](Scene&) {}}};

const Changeable* find_changeable(const std::string& path) {
  const auto* found = std::ranges::find_if(changeable, [&](const Changeable& part) { return path == part.path; });
  return found == changeable.end() ? nullptr : found;
}

/// Where an element and what stands in it were written.
void forget_lines(const std::string& path, SceneSource& source) {
  std::erase_if(source.lines,
                [&](const auto& line) { return line.first == path || line.first.starts_with(path + "."); });
}

/// What was taken out before stays out.
void add_resected(const std::vector<std::int32_t>& before, Scene& state) {
  if (state.resection) {
    std::vector<std::int32_t> labels = before;
    for (const std::int32_t label : state.resection->labels) {
      if (std::ranges::find(before, label) == before.end()) {
        labels.push_back(label);
      }
    }
    state.resection->labels = std::move(labels);
  }
}

std::vector<std::int32_t> resected(const Scene& scene) {
  return scene.resection ? scene.resection->labels : std::vector<std::int32_t>();
}

void change(const tinyxml2::XMLElement& xml, Scene& state) {
  const std::string path = xml.Name();
  const Where where{state.source, xml.GetLineNum(), ""};
  const Changeable* part = find_changeable(path);
  if (part == nullptr) {
    where.fail("a state cannot change <" + path + ">, which is the same for the whole sequence; it may change " +
               changeable_elements());
  }
  for (const auto* other = xml.PreviousSiblingElement(); other != nullptr; other = other->PreviousSiblingElement()) {
    if (path == other->Name()) {
      where.fail("the state changes <" + path + "> twice");
    }
  }
  if (path == "tissues") {
    change_tissues(xml, state);
    return;
  }
  part->forget(state);
  forget_lines(path, state.source);
  read_element(xml, "", state);
}

/// A state's name is a folder's, too.
std::string read_name(const tinyxml2::XMLElement& xml, const Where& where) {
  const char* name = xml.Attribute("name");
  const auto* first = xml.FirstAttribute();
  if (name == nullptr || first->Next() != nullptr) {
    where.fail("<state> takes the attribute 'name' and no other, as <state name=\"opened\">");
  }
  const std::string text = name;
  constexpr const char* allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  if (text.empty() || text.find_first_not_of(allowed) != std::string::npos) {
    where.fail("the state's name is '" + text + "'; letters, digits, - and _ are expected, for a folder has it, too");
  }
  return text;
}

void apply_overrides(const std::vector<std::string>& overrides, Scene& state) {
  const std::string prefix = "sequence." + state.state->name + ".";
  for (const std::string& text : overrides) {
    if (!text.starts_with(prefix)) {
      continue;
    }
    const std::string change = text.substr(prefix.size());
    if (find_changeable(change.substr(0, change.find_first_of(".="))) == nullptr) {
      Where{state.source, 0, ""}.fail("'" + text + "': a state may change " + changeable_elements());
    }
    apply_override(state, change);
  }
}

void read_state(const tinyxml2::XMLElement& xml, const std::vector<std::string>& overrides, Scene& scene) {
  const Where where{scene.source, xml.GetLineNum(), ""};
  if (std::string(xml.Name()) != "state") {
    where.fail("<sequence> has no element <" + std::string(xml.Name()) + ">; allowed: state");
  }
  const std::string name = read_name(xml, where);
  const auto same = [&](const Scene& state) { return state.state->name == name; };
  if (std::ranges::any_of(scene.states, same)) {
    where.fail("there are two states '" + name + "'; give them different names");
  }
  const bool first = scene.states.empty();
  Scene state = first ? scene : scene.states.back();
  state.state = StateOfSequence{name, first ? "" : scene.states.back().state->name};
  const std::vector<std::int32_t> before = resected(state);
  refuse_text(xml, scene.source);
  for (const auto* child = xml.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    change(*child, state);
  }
  apply_overrides(overrides, state);
  add_resected(before, state);
  if (!first && xml.FirstChildElement() == nullptr) {
    where.fail("the state '" + name + "' changes nothing; it may change " + changeable_elements());
  }
  const Scene& front = first ? state : scene.states.front();
  state.state->opening = front.load;
  state.state->tissues = front.tissues;
  scene.states.push_back(std::move(state));
}

/// Those of states that there are not.
void refuse_unknown_states(const std::vector<std::string>& overrides, const Scene& scene) {
  for (const std::string& text : overrides) {
    const auto names = [&](const Scene& state) { return text.starts_with("sequence." + state.state->name + "."); };
    if (is_of_a_state(text) && std::ranges::none_of(scene.states, names)) {
      std::vector<std::string> states;
      for (const Scene& state : scene.states) {
        states.push_back(state.state->name);
      }
      Where{scene.source, 0, ""}.fail("'" + text + "' is not sequence.STATE.PATH=VALUE; the scene's states are: " +
                                      (states.empty() ? "none" : with_commas(states)));
    }
  }
}

}  // namespace

std::string changeable_elements() {
  std::string names;
  for (const Changeable& part : changeable) {
    names += (names.empty() ? "" : ", ") + std::string(part.path);
  }
  return names;
}

bool is_of_a_state(std::string_view override) {
  return override.starts_with("sequence.");
}

void read_sequence(const tinyxml2::XMLElement& root, const std::vector<std::string>& overrides, Scene& scene) {
  if (const auto* xml = root.FirstChildElement("sequence")) {
    const Where where{scene.source, xml->GetLineNum(), ""};
    if (const auto* again = xml->NextSiblingElement("sequence")) {
      Where{scene.source, again->GetLineNum(), ""}.fail("<sequence> is there twice");
    }
    if (xml->FirstAttribute() != nullptr) {
      where.fail("<sequence> takes no attributes");
    }
    refuse_text(*xml, scene.source);
    scene.source.lines["sequence"] = xml->GetLineNum();
    for (const auto* child = xml->FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      read_state(*child, overrides, scene);
    }
    if (scene.states.empty()) {
      where.fail("<sequence> names no state; name one, as <state name=\"opened\">...</state>, or leave <sequence> out");
    }
  }
  refuse_unknown_states(overrides, scene);
}

}  // namespace brainshift::pipelines
