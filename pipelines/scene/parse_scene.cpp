// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/parse_scene.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <fstream>

#include "pipelines/scene/read_elements.hpp"
#include "pipelines/scene/read_sequence.hpp"
#include "pipelines/scene/scene_table.hpp"
#include "pipelines/scene/tissue_table.hpp"
#include "segmentation/files/readable_file.hpp"
#include "segmentation/labels/label_table.hpp"
#include "solve/material/named_materials.hpp"

namespace brainshift::pipelines {
namespace {

/// Classes that the scene does not name have their usual materials, unless it names tissues by number.
void complete_tissues(Scene& scene) {
  const bool numbered = std::any_of(scene.tissues.begin(), scene.tissues.end(),
                                    [](const Tissue& tissue) { return tissue.tissue_class == 0; });
  const bool image = !scene.image.labels.empty() || !scene.image.brain_mask.empty();
  if (numbered || !image || !is_ours(scene, StageId::segment)) {
    return;
  }
  for (const auto& usual : segmentation::brain_classes) {
    const auto same = [&usual](const Tissue& tissue) { return tissue.label == usual.number; };
    if (std::none_of(scene.tissues.begin(), scene.tissues.end(), same)) {
      Tissue tissue;
      tissue.label = tissue.tissue_class = usual.number;
      tissue.name = usual.name;
      tissue.named_material = usual_material(usual.number);
      tissue.material = solve::named_material(tissue.named_material).value();
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

/// Whether a line holds the character of number 0, or its name in XML: "&#0;", "&#x00;".
bool has_nul(const std::string& line) {
  bool found = line.find('\0') != std::string::npos;
  for (std::size_t at = line.find("&#"); at != std::string::npos && !found; at = line.find("&#", at + 2)) {
    const std::size_t first = at + 2 < line.size() && line[at + 2] == 'x' ? at + 3 : at + 2;
    const std::size_t end = line.find_first_not_of('0', first);
    found = end != std::string::npos && end > first && line[end] == ';';
  }
  return found;
}

/// The parser ends a value at a character of number 0, so that a file's name would be none.
void refuse_nul(const SceneSource& source) {
  std::ifstream stream(source.file, std::ios::binary);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (has_nul(line)) {
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
  const tinyxml2::XMLElement& root = open_scene(document, scene.source);
  read_elements(root, scene);
  for (const std::string& text : overrides) {
    if (!text.starts_with("tissues.") && !is_of_a_state(text)) {
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
  read_sequence(root, overrides, scene);
  for (const Scene& state : scene.states) {
    require_options(state);
  }
  return scene;
}

}  // namespace brainshift::pipelines
