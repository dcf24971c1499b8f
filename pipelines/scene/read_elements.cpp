// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/read_elements.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "pipelines/scene/scene_table.hpp"
#include "pipelines/scene/tissue_table.hpp"
#include "segmentation/files/whole_path.hpp"

namespace brainshift::pipelines {

void refuse_text(const tinyxml2::XMLElement& xml, const SceneSource& source) {
  for (const auto* node = xml.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node->ToText() != nullptr) {
      Where{source, node->GetLineNum(), ""}.fail("<" + std::string(xml.Name()) + "> holds the text '" + node->Value() +
                                                 "', but takes attributes and elements only");
    }
  }
}

namespace {

template <class T>
void set_value(const Option<T>& option, T& target, const std::string& value, const Where& where) {
  std::string stored = value;
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
  if (option.is_path && std::ranges::any_of(value, is_control)) {
    where.fail(where.element + " " + option.name + " holds a control character; a file's name is expected");
  }
  if (names_file(option, value)) {
    stored = whole_path(where.source.file.parent_path() / value).string();
  }
  if (!set_option(option, target, stored)) {
    where.fail(where.element + " " + refusal(option, value));
  }
}

template <class T>
const Option<T>& known_option(const OptionTable<T>& options, const std::string& name, const Where& where) {
  const Option<T>* option = find_option(options, name);
  if (option == nullptr) {
    where.fail(where.element + " has no attribute '" + name + "'; allowed: " + option_names(options));
  }
  return *option;
}

/// Reads the attributes of an element into the target, and where they were written into the source. They are applied
/// in the order of the options, so that a named material comes before the constants that differ from it.
template <class T>
void read_attributes(const tinyxml2::XMLElement& xml, const OptionTable<T>& options, T& target, const std::string& path,
                     SceneSource& source) {
  const std::string name = "<" + std::string(xml.Name()) + ">";
  std::map<std::string, const tinyxml2::XMLAttribute*> given;
  for (const auto* attribute = xml.FirstAttribute(); attribute != nullptr; attribute = attribute->Next()) {
    const std::string attribute_name = attribute->Name();
    if (attribute_name == "name" && std::string(xml.Name()) == "stage") {
      continue;
    }
    const Where where{source, attribute->GetLineNum(), name};
    known_option(options, attribute_name, where);
    if (!given.emplace(attribute_name, attribute).second) {
      where.fail(name + " names " + attribute_name + " twice");
    }
    source.lines[path + "." + attribute_name] = attribute->GetLineNum();
  }
  for (const auto& option : options) {
    if (const auto found = given.find(option.name); found != given.end()) {
      set_value(option, target, found->second->Value(), {source, found->second->GetLineNum(), name});
    } else if (option.required) {
      Where{source, xml.GetLineNum(), name}.fail(name + " needs the attribute '" + option.name + "' (" + option.help +
                                                 ")");
    }
  }
}

/// Reads a list, whose elements all have one name.
template <class Read>
void read_list(const tinyxml2::XMLElement& xml, const std::string& name, const SceneSource& source, const Read& read) {
  refuse_text(xml, source);
  for (const auto* child = xml.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    const Where where{source, child->GetLineNum(), ""};
    if (child->Name() != name) {
      where.fail("<" + std::string(xml.Name()) + "> has no element <" + child->Name() + ">; allowed: " + name);
    }
    read(*child, where);
  }
}

/// The element of the table that an XML element stands for; its path under `parent`.
std::string path_of(const tinyxml2::XMLElement& xml, const std::string& parent, const SceneSource& source) {
  const std::string name = xml.Name();
  if (name != "stage" || !parent.empty()) {
    return parent.empty() ? name : parent + "." + name;
  }
  const char* stage = xml.Attribute("name");
  if (stage == nullptr) {
    Where{source, xml.GetLineNum(), ""}.fail("<stage> needs the attribute 'name'");
  }
  try {
    stage_from_name(stage);
  } catch (const std::invalid_argument& error) {
    Where{source, xml.GetLineNum(), ""}.fail(error.what());
  }
  return stage;
}

/// The names that may stand under an element, for messages.
std::string allowed_children(const std::string& parent) {
  std::string names = parent.empty() ? "tissues, sequence, stage" : "";
  for (const Element& element : scene_elements()) {
    const bool under = parent.empty() ? element.path.find('.') == std::string::npos && !is_stage(element.path)
                                      : element.path.starts_with(parent + ".");
    if (under) {
      names += (names.empty() ? "" : ", ") + element.path.substr(parent.empty() ? 0 : parent.size() + 1);
    }
  }
  return names.empty() ? "none" : names;
}

/// Which tissue an element is about: its label, the first of its labels, or the number of its class.
std::string tissue_key(const tinyxml2::XMLElement& xml, const Where& where) {
  const char* label = xml.Attribute("label");
  const char* labels = xml.Attribute("labels");
  const char* tissue_class = xml.Attribute("class");
  if (int{label != nullptr} + int{labels != nullptr} + int{tissue_class != nullptr} != 1) {
    where.fail(
        "<tissue> needs one of the attributes 'label' (a number of the label map), 'labels' (several, as \"2 3 "
        "10-13\") and 'class' (parenchyma, ventricles or tumour)");
  }
  if (label != nullptr) {
    return label;
  }
  Tissue tissue;
  if (labels != nullptr) {
    find_option(tissue_options(), "labels")->read(tissue, labels);
    return tissue.labels.empty() ? "" : std::to_string(tissue.labels.front());
  }
  find_option(tissue_options(), "class")->read(tissue, tissue_class);
  return std::to_string(tissue.tissue_class);
}

/// Throws where a number of the map would be of two tissues.
void refuse_shared_labels(const Tissue& tissue, const std::vector<Tissue>& others, const Where& where) {
  const auto numbers_of = [](const Tissue& of) { return of.labels.empty() ? std::vector{of.label} : of.labels; };
  for (const Tissue& other : others) {
    const std::vector<std::uint16_t> taken = numbers_of(other);
    for (const std::uint16_t number : numbers_of(tissue)) {
      if (std::ranges::find(taken, number) != taken.end()) {
        where.fail("there are two tissues of label " + std::to_string(number) + "; take it out of one of them");
      }
    }
  }
}

/// The number that the stages know the tissue by.
void settle_label(Tissue& tissue, const Where& where) {
  if (tissue.label == 0) {
    tissue.label = tissue.labels.empty() ? tissue.tissue_class : tissue.labels.front();
  }
  if (tissue.label == 0) {
    where.fail("<tissue> names no label and no class");
  }
}

void refuse_attributes(const tinyxml2::XMLElement& xml, const SceneSource& source) {
  if (const auto* attribute = xml.FirstAttribute()) {
    Where{source, attribute->GetLineNum(), ""}.fail("<" + std::string(xml.Name()) + "> has no attribute '" +
                                                    attribute->Name() + "'; allowed: none");
  }
}

void read_tissues(const tinyxml2::XMLElement& xml, Scene& scene) {
  refuse_attributes(xml, scene.source);
  read_list(xml, "tissue", scene.source, [&](const tinyxml2::XMLElement& child, const Where& where) {
    const std::string path = "tissues." + tissue_key(child, where);
    Tissue tissue;
    read_attributes(child, tissue_options(), tissue, path, scene.source);
    settle_label(tissue, where);
    refuse_shared_labels(tissue, scene.tissues, where);
    scene.source.lines[path] = where.line;
    scene.tissues.push_back(std::move(tissue));
  });
}

void read_cuts(const tinyxml2::XMLElement& xml, Scene& scene) {
  read_list(xml, "cut", scene.source, [&](const tinyxml2::XMLElement& child, const Where& where) {
    if (child.Attribute("path") != nullptr) {
      where.fail(
          "<cut> has a path, which cuts a plane problem ('brainshift solve --plane'); a scene is in space: give a "
          "sheet, as <cut file=\"sheet.vtp\"/>");
    }
    const std::string path = "cuts." + std::to_string(scene.cuts->files.size() + 1);
    CutFile cut;
    read_attributes(child, cut_options(), cut, path, scene.source);
    scene.source.lines[path] = where.line;
    scene.cuts->files.push_back(std::move(cut));
  });
}

void read_children(const tinyxml2::XMLElement& xml, const std::string& parent, Scene& scene) {
  refuse_text(xml, scene.source);
  for (const auto* child = xml.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    read_element(*child, parent, scene);
  }
}

}  // namespace

void read_element(const tinyxml2::XMLElement& xml, const std::string& parent, Scene& scene) {
  const Where where{scene.source, xml.GetLineNum(), "<" + std::string(xml.Name()) + ">"};
  const std::string path = path_of(xml, parent, scene.source);
  const Element* element = find_element(path);
  const bool tissues = path == "tissues";
  const bool wrong_spelling = is_stage(path) && std::string(xml.Name()) != "stage";
  if (!tissues && (element == nullptr || wrong_spelling)) {
    where.fail("<" + std::string(xml.Parent()->Value()) + "> has no element " + where.element +
               "; allowed: " + allowed_children(parent));
  }
  if (!scene.source.lines.emplace(path, xml.GetLineNum()).second) {
    where.fail(where.element + " '" + path + "' is there twice");
  }
  if (tissues) {
    read_tissues(xml, scene);
    return;
  }
  element->add(scene);
  read_attributes(xml, element->options, scene, path, scene.source);
  if (path == "cuts") {
    read_cuts(xml, scene);
  } else {
    read_children(xml, path, scene);
  }
}

void read_elements(const tinyxml2::XMLElement& root, Scene& scene) {
  refuse_text(root, scene.source);
  for (const auto* child = root.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    if (std::string(child->Name()) != "sequence") {
      read_element(*child, "", scene);
    }
  }
}

namespace {

void set_tissue_option(Scene& scene, const std::string& label, const std::string& name, const std::string& value) {
  const Where where{scene.source, 0, "tissues." + label};
  for (Tissue& tissue : scene.tissues) {
    if (std::to_string(tissue.label) == label) {
      const Option<Tissue>& option = known_option(tissue_options(), name, where);
      if (names_tissue(option.name)) {
        where.fail("the label of a tissue cannot be changed; change the scene's file");
      }
      set_value(option, tissue, value, where);
      scene.source.lines["tissues." + label + "." + name] = 0;
      return;
    }
  }
  where.fail("the scene has no tissue of label '" + label + "'");
}

}  // namespace

void change_tissues(const tinyxml2::XMLElement& xml, Scene& scene) {
  refuse_attributes(xml, scene.source);
  std::set<std::string> changed;
  read_list(xml, "tissue", scene.source, [&](const tinyxml2::XMLElement& child, const Where& where) {
    const std::string key = tissue_key(child, where);
    if (!changed.insert(key).second) {
      where.fail("the state changes the tissue of label " + key + " twice; change it once");
    }
    const auto found =
        std::ranges::find_if(scene.tissues, [&](const Tissue& tissue) { return std::to_string(tissue.label) == key; });
    if (found == scene.tissues.end()) {
      where.fail("a state changes tissues that the scene has, and it has none of label " + key);
    }
    const std::vector<std::uint16_t> labels = found->labels;
    read_attributes(child, tissue_options(), *found, "tissues." + key, scene.source);
    if (found->labels != labels && child.Attribute("labels") != nullptr) {
      where.fail("a state cannot change which labels a tissue has");
    }
    found->labels = labels;
  });
}

void apply_override(Scene& scene, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string path = text.substr(0, equals);
  const std::size_t dot = path.rfind('.');
  const Where where{scene.source, 0, path.substr(0, dot)};
  if (equals == std::string::npos || dot == std::string::npos) {
    where.fail("'" + text + "' is not PATH=VALUE, as segment.edge_length=4 is");
  }
  const std::string value = text.substr(equals + 1);
  if (path.starts_with("tissues.")) {
    set_tissue_option(scene, path.substr(8, dot < 8 ? 0 : dot - 8), path.substr(dot + 1), value);
    return;
  }
  const Element* element = find_element(where.element);
  if (element == nullptr) {
    std::string names = "tissues.LABEL";
    for (const Element& known : scene_elements()) {
      names += ", " + known.path;
    }
    where.fail("there is no element '" + where.element + "'; allowed: " + names);
  }
  element->add(scene);
  set_value(known_option(element->options, path.substr(dot + 1), where), scene, value, where);
  scene.source.lines[path] = 0;
}

}  // namespace brainshift::pipelines
