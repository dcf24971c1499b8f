// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/describe_scene.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pipelines/scene/read_sequence.hpp"
#include "pipelines/scene/scene_table.hpp"
#include "pipelines/scene/tissue_table.hpp"

namespace brainshift::pipelines {
namespace {

template <class T>
std::string help_lines(const OptionTable<T>& options) {
  std::string text;
  for (const auto& option : options) {
    text += "       " + option.name + ": " + option.help + " [" + option.allowed +
            (option.unit.empty() ? "" : ", " + option.unit) + "]" + (option.required ? " (required)" : "") + "\n";
  }
  return text;
}

template <class T>
std::string attributes(const OptionTable<T>& options, const T& target) {
  std::string text;
  for (const auto& option : options) {
    text += " " + option.name + "=\"" + option.get(target) + "\"";
  }
  return text;
}

std::string comment(const std::string& help, const std::string& lines) {
  return "  <!-- " + help + (lines.empty() ? "" : "\n" + lines + "  ") + (lines.empty() ? " -->\n" : "-->\n");
}

/// An optional part: the way to name it, in the comment that explains it. (A comment cannot hold "--".)
std::string optional_part(const Element& element, const Scene& scene) {
  const std::size_t dot = element.path.find('.');
  const std::string inner = element.path.substr(dot == std::string::npos ? 0 : dot + 1);
  std::string example = "<" + inner + attributes(element.options, scene) + "/>";
  if (dot != std::string::npos) {
    example = "<" + element.path.substr(0, dot) + ">" + example + "</" + element.path.substr(0, dot) + ">";
  }
  return comment("Not built unless named. " + element.help, help_lines(element.options) + "       " + example + "\n");
}

std::string cuts_part(const Element& cuts, const Scene& scene) {
  return comment("Not built unless named. " + cuts.help,
                 help_lines(cuts.options) + "       Each cut:\n" + help_lines(cut_options()) + "       <cuts" +
                     attributes(cuts.options, scene) + "><cut" + attributes(cut_options(), CutFile{}) + "/></cuts>\n");
}

std::string tissues_part() {
  Tissue tissue;
  tissue.label = 1;
  // Constants beside a named material override it, so the example of all constants names none.
  OptionTable<Tissue> constants = tissue_options();
  std::erase_if(constants, [](const auto& option) {
    return option.name == "material" || option.name == "labels" || option.name == "class";
  });
  const std::string example = "<tissues><tissue" + attributes(constants, tissue) + "/></tissues>";
  return comment("The brain's tissues: one element a label.",
                 help_lines(tissue_options()) + "       " + example +
                     "\n       or <tissues><tissue label=\"1\" material=\"brain_viscoelastic\"/></tissues>\n"
                     "       or <tissues><tissue labels=\"2 3 10-13\" material=\"brain\"/></tissues>\n"
                     "       or <tissues><tissue class=\"ventricles\" youngs_modulus=\"20\"/></tissues>\n");
}

std::string sequence_part() {
  return comment("Not built unless named. An operation in order: each state goes on from the one before it.",
                 "       It names what it changes: " + changeable_elements() +
                     ".\n       <sequence><state name=\"opened\"/><state name=\"drained\"><gravity "
                     "direction=\"0,1,0\" drained=\"30\"/></state></sequence>\n");
}

}  // namespace

std::string default_scene() {
  Scene everything;
  for (const Element& element : scene_elements()) {
    element.add(everything);
  }
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!-- A brainshift scene with every option at its default. File names are relative to this file. -->\n"
      "<scene version=\"1\">\n";
  for (const Element& element : scene_elements()) {
    if (element.path == "cuts") {
      text += cuts_part(element, everything);
      continue;
    }
    if (element.optional) {
      text += optional_part(element, everything);
      continue;
    }
    const bool stage = is_stage(element.path);
    text += comment(element.help, help_lines(element.options));
    text += "  <" + (stage ? "stage name=\"" + element.path + "\"" : element.path) +
            attributes(element.options, everything) + "/>\n";
    if (element.path == "image") {
      text += tissues_part();
    }
  }
  return text + sequence_part() + "</scene>\n";
}

nlohmann::ordered_json effective_options(const Scene& scene) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const Element& element : scene_elements()) {
    if (!element.present(scene)) {
      continue;
    }
    auto& part = json[element.path] = nlohmann::ordered_json::object();
    for (const auto& option : element.options) {
      part[option.name] = option.get(scene);
    }
    if (element.path == "cuts") {
      for (std::size_t i = 0; i < scene.cuts->files.size(); ++i) {
        for (const auto& option : cut_options()) {
          part[std::to_string(i + 1)][option.name] = option.get(scene.cuts->files[i]);
        }
      }
    }
    if (element.path == "image") {
      auto& tissues = json["tissues"] = nlohmann::ordered_json::object();
      for (const Tissue& tissue : scene.tissues) {
        for (const auto& option : tissue_options()) {
          tissues[std::to_string(tissue.label)][option.name] = option.get(tissue);
        }
      }
    }
  }
  return json;
}

}  // namespace brainshift::pipelines
