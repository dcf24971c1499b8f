// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/parse_scene.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <stdexcept>

#include "pipelines/scene/scene_table.hpp"
#include "segmentation/files/readable_file.hpp"
#include "solve/material/named_materials.hpp"

namespace brainshift::pipelines {
namespace {

/// Where a value is written, as messages say it.
struct Where {
  const SceneSource& source;
  int line = 0;  ///< 0: --set
  std::string element;

  [[noreturn]] void fail(const std::string& what) const {
    const std::string at = line == 0 ? "--set" : source.file.string() + ":" + std::to_string(line);
    throw std::invalid_argument(at + ": " + what);
  }
};

template <class T>
void set_value(const Option<T>& option, T& target, const std::string& value, const Where& where) {
  std::string stored = value;
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
  if (option.is_path && std::ranges::any_of(value, is_control)) {
    where.fail(where.element + " " + option.name + " holds a control character; a file's name is expected");
  }
  if (names_file(option, value)) {
    stored = (where.source.file.parent_path() / value).lexically_normal().string();
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
  std::string names = parent.empty() ? "tissues, stage" : "";
  for (const Element& element : scene_elements()) {
    const bool under = parent.empty() ? element.path.find('.') == std::string::npos && !is_stage(element.path)
                                      : element.path.starts_with(parent + ".");
    if (under) {
      names += (names.empty() ? "" : ", ") + element.path.substr(parent.empty() ? 0 : parent.size() + 1);
    }
  }
  return names.empty() ? "none" : names;
}

void refuse_text(const tinyxml2::XMLElement& xml, const SceneSource& source) {
  for (const auto* node = xml.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node->ToText() != nullptr) {
      Where{source, node->GetLineNum(), ""}.fail("<" + std::string(xml.Name()) + "> holds the text '" + node->Value() +
                                                 "', but takes attributes and elements only");
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

/// The number that the stages know the tissue by.
void settle_label(Tissue& tissue, const Where& where) {
  if (tissue.label == 0) {
    tissue.label = tissue.labels.empty() ? tissue.tissue_class : tissue.labels.front();
  }
  if (tissue.label == 0) {
    where.fail("<tissue> names no label and no class");
  }
}

void read_tissues(const tinyxml2::XMLElement& xml, Scene& scene) {
  if (const auto* attribute = xml.FirstAttribute()) {
    Where{scene.source, attribute->GetLineNum(), ""}.fail("<tissues> has no attribute '" +
                                                          std::string(attribute->Name()) + "'; allowed: none");
  }
  read_list(xml, "tissue", scene.source, [&](const tinyxml2::XMLElement& child, const Where& where) {
    const std::string path = "tissues." + tissue_key(child, where);
    Tissue tissue;
    read_attributes(child, tissue_options(), tissue, path, scene.source);
    settle_label(tissue, where);
    const auto same = [&](const Tissue& other) { return other.label == tissue.label; };
    if (std::any_of(scene.tissues.begin(), scene.tissues.end(), same)) {
      where.fail("there are two tissues of label " + std::to_string(tissue.label));
    }
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
    const Where where{scene.source, child->GetLineNum(), "<" + std::string(child->Name()) + ">"};
    const std::string path = path_of(*child, parent, scene.source);
    const Element* element = find_element(path);
    const bool tissues = path == "tissues";
    const bool wrong_spelling = is_stage(path) && std::string(child->Name()) != "stage";
    if (!tissues && (element == nullptr || wrong_spelling)) {
      where.fail("<" + std::string(xml.Name()) + "> has no element " + where.element +
                 "; allowed: " + allowed_children(parent));
    }
    if (!scene.source.lines.emplace(path, child->GetLineNum()).second) {
      where.fail(where.element + " '" + path + "' is there twice");
    }
    if (tissues) {
      read_tissues(*child, scene);
      continue;
    }
    element->add(scene);
    read_attributes(*child, element->options, scene, path, scene.source);
    if (path == "cuts") {
      read_cuts(*child, scene);
    } else {
      read_children(*child, path, scene);
    }
  }
}

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

/// Classes that the scene does not name have their usual materials, unless it names tissues by number.
void complete_tissues(Scene& scene) {
  namespace label = segmentation::default_label;
  const bool numbered = std::any_of(scene.tissues.begin(), scene.tissues.end(),
                                    [](const Tissue& tissue) { return tissue.tissue_class == 0; });
  const bool image = !scene.image.labels.empty() || !scene.image.brain_mask.empty();
  if (numbered || !image || !is_ours(scene, StageId::segment)) {
    return;
  }
  struct Usual {
    std::uint16_t label;
    const char* name;
    const char* material;
  };
  for (const Usual& usual :
       {Usual{label::parenchyma, "parenchyma", "brain"}, Usual{label::ventricles, "ventricles", "ventricle"},
        Usual{label::tumour, "tumour", "tumour"}}) {
    const auto same = [&usual](const Tissue& tissue) { return tissue.label == usual.label; };
    if (std::none_of(scene.tissues.begin(), scene.tissues.end(), same)) {
      Tissue tissue;
      tissue.label = tissue.tissue_class = usual.label;
      tissue.name = usual.name;
      tissue.named_material = usual.material;
      tissue.material = solve::named_material(usual.material).value();
      scene.tissues.push_back(std::move(tissue));
    }
  }
}

/// What --set names may have left out.
void require_options(const Scene& scene) {
  for (const Element& element : scene_elements()) {
    for (const auto& option : element.options) {
      if (option.required && element.present(scene) && !scene.source.lines.contains(element.path + "." + option.name)) {
        Where{scene.source, 0, ""}.fail(element.path + " needs " + element.path + "." + option.name + " too (" +
                                        option.help + ")");
      }
    }
  }
}

/// The parser ends a value at a character of number 0, so that a file's name would be none.
void refuse_nul(const SceneSource& source) {
  std::ifstream stream(source.file, std::ios::binary);
  static const std::regex nul("&#x?0+;");
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.find('\0') != std::string::npos ||
        (line.find("&#") != std::string::npos && std::regex_search(line, nul))) {
      Where{source, number, ""}.fail("there is a character of number 0 here; remove it");
    }
  }
}

const tinyxml2::XMLElement& open_scene(tinyxml2::XMLDocument& document, const SceneSource& source) {
  check_readable(source.file);
  refuse_nul(source);
  if (document.LoadFile(source.file.c_str()) != tinyxml2::XML_SUCCESS) {
    Where{source, std::max(1, document.ErrorLineNum()), ""}.fail(
        "this is not well-formed XML; see 'brainshift scene --defaults' for how a scene looks");
  }
  const tinyxml2::XMLElement* root = document.RootElement();
  if (root == nullptr || std::string(root->Name()) != "scene") {
    Where{source, root == nullptr ? 1 : root->GetLineNum(), ""}.fail("a scene begins with <scene version=\"1\">");
  }
  for (const auto* node = document.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node != root && (node->ToText() != nullptr || node->ToElement() != nullptr)) {
      Where{source, node->GetLineNum(), ""}.fail("there is something beside the <scene>, which would be ignored");
    }
  }
  const char* version = root->Attribute("version");
  const auto* first = root->FirstAttribute();
  if (first != nullptr && (version == nullptr || std::string(version) != "1" || first->Next() != nullptr)) {
    Where{source, root->GetLineNum(), ""}.fail("<scene> takes the attribute version=\"1\" and no other");
  }
  return *root;
}

}  // namespace

Scene parse_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Scene scene;
  scene.source.file = file;
  tinyxml2::XMLDocument document;
  read_children(open_scene(document, scene.source), "", scene);
  for (const std::string& text : overrides) {
    if (!text.starts_with("tissues.")) {
      apply_override(scene, text);
    }
  }
  complete_tissues(scene);
  for (const std::string& text : overrides) {
    if (text.starts_with("tissues.")) {
      apply_override(scene, text);
    }
  }
  require_options(scene);
  return scene;
}

}  // namespace brainshift::pipelines
