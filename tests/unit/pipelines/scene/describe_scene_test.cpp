// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/describe_scene.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipelines/scene/scene_table.hpp"
#include "pipelines/scene/tissue_table.hpp"
#include "tests/unit/pipelines/scene_file.hpp"

namespace brainshift::pipelines::describe_scene_test {

TEST_F(SceneFile, DefaultsParseAndGiveExactlyTheDefaults) {
  EXPECT_EQ(effective_options(parse(default_scene())), effective_options(Scene{}));
}

TEST_F(SceneFile, DefaultsNameEveryOption) {
  const std::string text = default_scene();
  for (const Element& element : scene_elements()) {
    for (const auto& option : element.options) {
      expect_parts(text, {" " + option.name + "=\"", option.name + ": " + option.help});
    }
  }
}

TEST_F(SceneFile, PartsInTheCommentsOfTheDefaultsParseToo) {
  std::string text = default_scene();
  for (const std::string part : {"<contact", "<tissues", "<load><simulated", "<cuts", "<resection"}) {
    const std::size_t begin = text.find(part);
    const std::string example = text.substr(begin, text.find('\n', begin) - begin);
    text.insert(text.find("</scene>"), example + "\n");
  }
  const Scene scene = parse(text);
  EXPECT_TRUE(scene.contact);
  EXPECT_TRUE(scene.load && scene.load->simulated);
  ASSERT_EQ(scene.tissues.size(), 1U);
  EXPECT_EQ(scene.tissues[0].material.youngs_modulus, solve::Material{}.youngs_modulus);
  EXPECT_TRUE(scene.resection);
  ASSERT_TRUE(scene.cuts);
  EXPECT_EQ(scene.cuts->files.size(), 1U);
}

TEST_F(SceneFile, DefaultsExplainEveryOptionOfACut) {
  const std::string text = default_scene();
  for (const auto& option : cut_options()) {
    expect_parts(text, {" " + option.name + "=\"", option.name + ": " + option.help});
  }
}

TEST_F(SceneFile, DefaultsExplainEveryOptionOfATissue) {
  const std::string text = default_scene();
  for (const auto& option : tissue_options()) {
    expect_parts(text, {" " + option.name + "=\"", option.name + ": " + option.help});
  }
  const std::string by_name = "<tissues><tissue label=\"1\" material=\"brain_viscoelastic\"/></tissues>";
  expect_parts(text, {by_name});
  EXPECT_EQ(parse("<scene>" + by_name + "</scene>").tissues.at(0).material.prony.size(), 2U);
}

}  // namespace brainshift::pipelines::describe_scene_test
