// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/scene_table.hpp"

#include <gtest/gtest.h>

#include <set>

#include "pipelines/scene/tissue_table.hpp"
#include "solve/material/named_materials.hpp"

namespace brainshift::pipelines::scene_table_test {

/// An option by its path, "segment.edge_length".
const Option<Scene>& option_at(const std::string& element, const std::string& name) {
  return *find_option(find_element(element)->options, name);
}

TEST(SceneTable, NamesEachElementAndOptionOnceWithHelp) {
  std::set<std::string> paths;
  for (const Element& element : scene_elements()) {
    EXPECT_TRUE(paths.insert(element.path).second) << element.path;
    EXPECT_EQ(find_element(element.path), &element);
    EXPECT_FALSE(element.help.empty()) << element.path;
    for (const auto& option : element.options) {
      EXPECT_TRUE(paths.insert(element.path + "." + option.name).second) << element.path << "." << option.name;
      EXPECT_FALSE(option.help.empty() || option.allowed.empty()) << element.path << "." << option.name;
    }
  }
  for (const StageId stage : all_stages) {
    EXPECT_NE(find_element(std::string(stage_name(stage))), nullptr);
  }
  EXPECT_EQ(find_element("tissues"), nullptr) << "each has a label of its own";
  EXPECT_EQ(find_element("load.guess"), nullptr);
}

TEST(SceneTable, APartIsThereOnceItIsAddedAndKeepsItsValues) {
  for (const Element& element : scene_elements()) {
    Scene scene;
    EXPECT_EQ(element.present(scene), !element.optional) << element.path;
    element.add(scene);
    EXPECT_TRUE(element.present(scene)) << element.path;
    for (const auto& option : element.options) {
      EXPECT_TRUE(option.holds(scene)) << element.path << "." << option.name << " by default";
    }
  }
  Scene scene;
  find_element("resection")->add(scene);
  scene.resection->pressure = 7;
  find_element("resection")->add(scene);
  EXPECT_EQ(scene.resection->pressure, 7);
  find_element("load.simulated")->add(scene);
  EXPECT_TRUE(scene.load);
  EXPECT_FALSE(scene.load->craniotomy);
}

TEST(SceneTable, EveryOptionReadsBackWhatItWrites) {
  Scene scene;
  for (const Element& element : scene_elements()) {
    element.add(scene);
    for (const auto& option : element.options) {
      const std::string value = option.get(scene);
      EXPECT_TRUE(set_option(option, scene, value)) << element.path << "." << option.name << " = '" << value << "'";
      EXPECT_EQ(option.get(scene), value);
    }
  }
}

TEST(SceneTable, EveryTissueOptionReadsBackWhatItWrites) {
  for (const std::string& name : solve::material_names()) {
    Tissue tissue{1, "a name", name, *solve::named_material(name)};
    Tissue copy;
    for (const auto& option : tissue_options()) {
      EXPECT_TRUE(set_option(option, copy, option.get(tissue))) << option.name;
    }
    for (const auto& option : tissue_options()) {
      EXPECT_EQ(option.get(copy), option.get(tissue));
    }
  }
}

TEST(SceneTable, AMaterialSetsTheConstantsAndAnUnknownOneNothing) {
  const Option<Tissue>& material = *find_option(tissue_options(), "material");
  Tissue tissue;
  tissue.material.youngs_modulus = 1;
  EXPECT_FALSE(material.read(tissue, "bran"));
  EXPECT_EQ(tissue.material.youngs_modulus, 1);
  EXPECT_EQ(tissue.named_material, "");
  EXPECT_TRUE(material.read(tissue, "tumour"));
  EXPECT_EQ(tissue.material.youngs_modulus, solve::named_material("tumour")->youngs_modulus);
  EXPECT_TRUE(material.read(tissue, ""));
  EXPECT_EQ(tissue.named_material, "");
  EXPECT_TRUE(names_tissue("label") && names_tissue("labels") && names_tissue("class"));
  EXPECT_FALSE(names_tissue("name"));
}

TEST(SceneTable, TheTradeoffTakesWhatTheListedOptionsTake) {
  Scene scene;
  find_element("tradeoff")->add(scene);
  EXPECT_TRUE(set_option(option_at("tradeoff", "basis"), scene, "linear, quadratic"));
  EXPECT_EQ(scene.tradeoff->basis, "linear, quadratic");
  for (const auto& [name, words] : {std::pair("basis", "linear cubic"),
                                    {"tolerance", "0.1 0"},
                                    {"nodes", "29"},
                                    {"points_per_cell", ""},
                                    {"reference_nodes", "many"}}) {
    EXPECT_FALSE(set_option(option_at("tradeoff", name), scene, words)) << name;
  }
  EXPECT_EQ(scene.tradeoff->basis, "linear, quadratic");
}

TEST(SceneTable, CommandsAreThoseOfTheirStage) {
  for (const StageId stage : all_stages) {
    Scene scene;
    EXPECT_TRUE(set_option(option_at(std::string(stage_name(stage)), "command"), scene, "a {in} {out}"));
    for (const StageId other : all_stages) {
      EXPECT_EQ(scene.commands[index_of(other)], other == stage ? "a {in} {out}" : "");
    }
  }
}

}  // namespace brainshift::pipelines::scene_table_test
