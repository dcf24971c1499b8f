// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/slicer/description.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>

#include "pipelines/scene/presets.hpp"
#include "pipelines/scene/scene_table.hpp"

namespace brainshift::pipelines {
namespace {

using Kind = SlicerParameter::Kind;
using Attributes = std::vector<std::pair<std::string, std::string>>;

const Option<Scene>& option_of(const std::string& element, const std::string& name) {
  return *find_option(find_element(element)->options, name);
}

std::vector<std::string> split_choices(std::string text) {
  std::vector<std::string> choices;
  constexpr std::string_view bar = " | ";
  for (std::size_t at = text.find(bar); at != std::string::npos; at = text.find(bar)) {
    choices.push_back(text.substr(0, at));
    text.erase(0, at + bar.size());
  }
  choices.push_back(text);
  return choices;
}

SlicerParameter option(const std::string& element, const std::string& name) {
  const Option<Scene>& described = option_of(element, name);
  Scene defaults;
  find_element(element)->add(defaults);
  const std::string value = described.get(defaults);
  SlicerParameter parameter{.flag = name,
                            .tag = "string",
                            .attributes = {},
                            .label = name + (described.unit.empty() ? "" : " (" + described.unit + ")"),
                            .description = described.help + " [" + described.allowed + "]",
                            .default_value = value,
                            .path = element + "." + name};
  std::replace(parameter.label.begin(), parameter.label.end(), '_', ' ');
  // An empty text is not passed on, but an empty number is: what may be absent stays a text.
  if (described.range && !value.empty()) {
    parameter.tag = described.allowed.starts_with("a whole number") ? "integer" : "double";
    parameter.range = *described.range;
  } else if (described.allowed == "three numbers") {
    parameter.tag = "double-vector";
    std::replace(parameter.default_value.begin(), parameter.default_value.end(), ' ', ',');
  } else if (!described.is_path && described.allowed.find(" | ") != std::string::npos) {
    parameter.tag = "string-enumeration";
    parameter.choices = split_choices(described.allowed);
  }
  return parameter;
}

SlicerParameter input(const std::string& flag, const std::string& tag, const Attributes& attributes,
                      const std::string& label, const Option<Scene>& described) {
  return {.flag = flag,
          .tag = tag,
          .attributes = attributes,
          .label = label,
          .description = described.help,
          .kind = Kind::input};
}

SlicerParameter output(const std::string& flag, const std::string& tag, const Attributes& attributes,
                       const std::string& label, const std::string& description, const std::string& path) {
  return {.flag = flag,
          .tag = tag,
          .attributes = attributes,
          .label = label,
          .description = description,
          .kind = Kind::output,
          .path = path};
}

SlicerParameter returned(const std::string& name, const std::string& tag, const std::string& label,
                         const std::string& description) {
  return {.flag = name,
          .tag = tag,
          .attributes = {},
          .label = label,
          .description = description,
          .default_value = tag == "double" ? "0" : "",
          .kind = Kind::returned};
}

SlicerGroup inputs() {
  const Attributes points = {{"fileExtensions", ".mrk.json"}, {"coordinateSystem", "lps"}};
  return {"Input",
          "The head as it was scanned, and the same points of the cortex before and after.",
          false,
          {input("t1", "image", {{"type", "scalar"}}, "T1", option_of("image", "t1")),
           input("labels", "image", {{"type", "label"}}, "Segmentation", option_of("image", "labels")),
           input("before", "pointfile", points, "Points before", option_of("load.markups", "before")),
           input("after", "pointfile", points, "Points after", option_of("load.markups", "after"))}};
}

SlicerGroup outputs() {
  const Attributes scalar = {{"type", "scalar"}, {"fileExtensions", ".nii.gz"}};
  return {
      "Output",
      "Each is optional.",
      false,
      {output("warped", "image", scalar, "Warped T1", "the T1 as it lies in the intraoperative brain",
              "register/warped.nii.gz"),
       output("warpedlabels", "image", {{"type", "label"}, {"fileExtensions", ".nii.gz"}}, "Warped segmentation",
              "the labels as they lie in the intraoperative brain", "register/warped_labels.nii.gz"),
       output("transform", "transform", {{"type", "nonlinear"}, {"fileExtensions", ".h5"}, {"reference", "t1"}},
              "Transform", "takes all that is put under it from the preoperative to the intraoperative brain",
              "register/from-preop_to-intraop_mode-image_xfm.h5"),
       output("brain", "geometry", {{"type", "model"}, {"fileExtensions", ".vtp"}}, "Brain surface",
              "the brain's surface as it lies during the operation, with displacement_mm at its points",
              "register/brain_intraop.vtp"),
       output("displacement", "image", scalar, "Displacement", "its length in mm, over the warped T1",
              "register/intraop_to_preop.nii.gz"),
       output("error", "image", scalar, "Estimated error",
              "of the computation, for want of nodes, in mm, over the warped T1", "register/estimated_error.nii.gz"),
       output("run", "directory", {}, "Run folder",
              "keeps the run, with the report and the scene; a run in it is continued", "")}};
}

SlicerGroup options() {
  SlicerParameter preset{.flag = "preset",
                         .tag = "string-enumeration",
                         .attributes = {},
                         .label = "preset",
                         .description = preset_help(),
                         .default_value = "balanced",
                         .choices = split_choices(preset_names())};
  return {"Options",
          "The others stand in the scene of the run folder.",
          true,
          {preset, option("image", "labels_are"), option("load", "noise"), option("load", "registration"),
           option("segment", "edge_length"), option("solve", "gravity"), option("solve", "max_steps"),
           option("register", "fade"), option("register", "interpolation")}};
}

SlicerGroup results() {
  return {"Result",
          "What the run says of itself.",
          false,
          {returned("largest_displacement_mm", "double", "largest displacement (mm)", "of the nodes"),
           returned("estimated_error_95_mm", "double", "estimated error (mm)",
                    "95 % of the nodes are off by less, for want of nodes"),
           returned("warning", "string", "warning", "what did not converge, and what the run warns of; else empty")}};
}

void push_text(tinyxml2::XMLPrinter& xml, const char* name, const std::string& text) {
  xml.OpenElement(name);
  xml.PushText(text.c_str());
  xml.CloseElement();
}

/// In the order that CTK's schema wants; Slicer takes any.
void push_parameter(tinyxml2::XMLPrinter& xml, const SlicerParameter& parameter, bool as_files) {
  const bool is_plain_file = as_files && (parameter.tag == "transform" || parameter.tag == "pointfile");
  xml.OpenElement(is_plain_file ? "file" : parameter.tag.c_str());
  for (const auto& [name, value] : parameter.attributes) {
    if (!is_plain_file || name == "fileExtensions") {
      xml.PushAttribute(name.c_str(), value.c_str());
    }
  }
  push_text(xml, "name", parameter.flag);
  if (parameter.kind != Kind::returned) {
    push_text(xml, "longflag", parameter.flag);
  } else if (as_files) {
    push_text(xml, "index", "1000");  // by which CTK knows what is returned; Slicer, by the want of flag and index
  }
  push_text(xml, "description", parameter.description);
  push_text(xml, "label", parameter.label);
  if (!parameter.default_value.empty()) {
    push_text(xml, "default", parameter.default_value);
  }
  if (parameter.kind != Kind::option) {
    push_text(xml, "channel", parameter.kind == Kind::input ? "input" : "output");
  }
  for (const std::string& choice : parameter.choices) {
    push_text(xml, "element", choice);
  }
  const bool low = std::isfinite(parameter.range.low), high = std::isfinite(parameter.range.high);
  if (!as_files && (low || high)) {  // CTK wants both and a step; the program checks in any case
    xml.OpenElement("constraints");
    if (low) {
      push_text(xml, "minimum", write_number(parameter.range.low));
    }
    if (high) {
      push_text(xml, "maximum", write_number(parameter.range.high));
    }
    xml.CloseElement();
  }
  xml.CloseElement();
}

}  // namespace

const std::vector<SlicerGroup>& slicer_groups() {
  static const std::vector<SlicerGroup> groups = {inputs(), outputs(), options(), results()};
  return groups;
}

std::string slicer_description(bool as_files) {
  tinyxml2::XMLPrinter xml;
  xml.PushDeclaration("xml version=\"1.0\" encoding=\"utf-8\"");
  xml.OpenElement("executable");
  push_text(xml, "category", "Registration");
  push_text(xml, "title", "Brain Shift (command line)");
  push_text(xml, "description",
            "Computes by mechanics how the whole brain moved when points of its cortex did, and warps the T1 to match. "
            "Research software, not a medical device.");
  push_text(xml, "version", BRAINSHIFT_VERSION);
  push_text(xml, "license", "GPL-3.0-or-later");
  for (const SlicerGroup& group : slicer_groups()) {
    xml.OpenElement("parameters");
    if (group.advanced) {
      xml.PushAttribute("advanced", "true");
    }
    push_text(xml, "label", group.label);
    push_text(xml, "description", group.description);
    for (const SlicerParameter& parameter : group.parameters) {
      push_parameter(xml, parameter, as_files);
    }
    xml.CloseElement();
  }
  xml.CloseElement();
  return std::string(xml.CStr()) + "\n";
}

}  // namespace brainshift::pipelines
