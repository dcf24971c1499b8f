// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/slicer/description.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <set>

#include "pipelines/scene/scene_table.hpp"

namespace brainshift::pipelines::description_test {

using Kind = SlicerParameter::Kind;

std::vector<SlicerParameter> parameters() {
  std::vector<SlicerParameter> all;
  for (const SlicerGroup& group : slicer_groups()) {
    all.insert(all.end(), group.parameters.begin(), group.parameters.end());
  }
  return all;
}

const SlicerParameter& find(const std::vector<SlicerParameter>& all, const std::string& flag) {
  return *std::find_if(all.begin(), all.end(), [&](const auto& p) { return p.flag == flag; });
}

/// The first child of that name that `flag` describes, in the XML.
std::string element_of(const std::string& xml, const std::string& flag) {
  tinyxml2::XMLDocument document;
  document.Parse(xml.c_str());
  const auto* group = document.FirstChildElement("executable")->FirstChildElement("parameters");
  for (; group != nullptr; group = group->NextSiblingElement("parameters")) {
    for (const auto* e = group->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const auto* name = e->FirstChildElement("name");
      if (name != nullptr && name->GetText() == flag) {
        tinyxml2::XMLPrinter text(nullptr, true);
        e->Accept(&text);
        return text.CStr();
      }
    }
  }
  return {};
}

TEST(SlicerDescription, NamesAreUniqueAndWithoutADash) {
  std::set<std::string> names;
  for (const SlicerParameter& parameter : parameters()) {
    EXPECT_TRUE(names.insert(parameter.flag).second) << parameter.flag;
    EXPECT_EQ(parameter.flag.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789"), std::string::npos);
  }
}

TEST(SlicerDescription, OptionsHaveRangeHelpAndDefaultOfTheTable) {
  Scene defaults;
  for (const SlicerParameter& parameter : parameters()) {
    const std::size_t dot = parameter.path.rfind('.');
    if (parameter.kind != Kind::option || parameter.path.empty()) {
      continue;
    }
    const Element* element = find_element(parameter.path.substr(0, dot));
    ASSERT_NE(element, nullptr) << parameter.path;
    const auto* option = find_option(element->options, parameter.path.substr(dot + 1));
    ASSERT_NE(option, nullptr) << parameter.path;
    EXPECT_TRUE(parameter.description.starts_with(option->help));
    element->add(defaults);
    Scene set;
    element->add(set);
    ASSERT_TRUE(set_option(*option, set, parameter.default_value)) << parameter.path;
    EXPECT_EQ(option->get(set), option->get(defaults));
    for (const std::string& choice : parameter.choices) {
      EXPECT_TRUE(set_option(*option, set, choice)) << choice;
    }
  }
}

TEST(SlicerDescription, ANumberThatMayBeAbsentIsAText) {
  const auto all = parameters();
  EXPECT_EQ(find(all, "noise").tag, "string");
  EXPECT_EQ(find(all, "fade").tag, "double");
  EXPECT_EQ(find(all, "max_steps").tag, "integer");
  EXPECT_EQ(find(all, "gravity").tag, "double-vector");
  EXPECT_EQ(find(all, "interpolation").tag, "string-enumeration");
}

TEST(SlicerDescription, WhatIsReturnedHasNoFlag) {
  const std::string xml = slicer_description(false);
  EXPECT_EQ(element_of(xml, "warning").find("longflag"), std::string::npos);
  EXPECT_EQ(element_of(xml, "warning").find("index"), std::string::npos);
  EXPECT_NE(element_of(xml, "fade").find("<longflag>fade</longflag>"), std::string::npos);
  EXPECT_NE(element_of(xml, "fade").find("<maximum>1000</maximum>"), std::string::npos);
  EXPECT_TRUE(element_of(xml, "transform").starts_with("<transform type=\"nonlinear\""));
  EXPECT_NE(element_of(xml, "before").find("coordinateSystem=\"lps\""), std::string::npos);
}

TEST(SlicerDescription, AsFilesItHasNoTypeOfSlicersOwn) {
  const std::string xml = slicer_description(true);
  EXPECT_TRUE(element_of(xml, "transform").starts_with("<file fileExtensions=\".h5\">"));
  EXPECT_TRUE(element_of(xml, "before").starts_with("<file fileExtensions=\".mrk.json\">"));
  EXPECT_NE(element_of(xml, "warning").find("<index>1000</index>"), std::string::npos);
  EXPECT_EQ(xml.find("constraints"), std::string::npos);
}

}  // namespace brainshift::pipelines::description_test
