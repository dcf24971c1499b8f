// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/explain_scene.hpp"

#include <gtest/gtest.h>

#include "tests/unit/pipelines/scene_file.hpp"

namespace brainshift::pipelines::explain_scene_test {

TEST_F(SceneFile, ExplainTellsActivePartsFromThoseNotBuilt) {
  write_image(folder_ / "labels.nii.gz", block_labels());
  write_load();
  const Scene scene = parse(R"(<scene><image labels="labels.nii.gz"/>
  <tissues><tissue label="1"/><tissue label="3"/></tissues>
  <load><craniotomy file="load.csv"/></load>
  <stage name="discretise" nodes="1000" command="mesher {in} {out}"/></scene>)");
  const std::string text = explain_scene(scene);
  expect_parts(text, {"load.craniotomy: active", "load.simulated: not built", "contact: not built", "mesher {in} {out}",
                      "register: 64 voxels", "integration points", "MB", "tissue 1: neo_hookean, E 3000 Pa",
                      "dilatation 2.2", "dynamics: relaxation to 0.01 mm", "gravity: not active"});
}

/// The shares that stand before a word, each "  part: M % of memory, T % of time".
double sum_of_shares(const std::string& text, const std::string& word) {
  double sum = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t begin = text.find_last_of(":,", at) + 1;
    sum += std::stod(text.substr(begin, at - begin));
  }
  return sum;
}

TEST_F(SceneFile, ExplainNamesTheLineOfAPartAndSharesAddUp) {
  write_image(folder_ / "labels.nii.gz", block_labels());
  write_load();
  const std::string start = R"(<scene><image labels="labels.nii.gz"/>
  <tissues><tissue label="1"/><tissue label="3"/></tissues>
  <load><craniotomy file="load.csv"/></load>
)";
  const std::string with = explain_scene(parse(start + "<contact/></scene>"));
  expect_parts(with, {"contact: active, named in ", "scene.xml:4", "pressure patches: ", "the default"});
  EXPECT_NEAR(sum_of_shares(with, " % of memory"), 100, 0.4);  // each is rounded to a tenth
  EXPECT_NEAR(sum_of_shares(with, " % of time"), 100, 0.4);
  const std::string without = explain_scene(parse(start + "</scene>"));
  EXPECT_EQ(without.find("contact: 1"), std::string::npos);
  expect_parts(without, {"contact: not built"});
  EXPECT_NEAR(sum_of_shares(without, " % of memory"), 100, 0.4);
}

TEST_F(SceneFile, ExplainSaysWhichPhysicsIsActive) {
  const std::string text = explain_scene(parse(R"(<scene>
  <tissues><tissue label="1" name="brain" material="brain_viscoelastic"/></tissues>
  <stage name="solve" basis="linear" volumetric="pointwise" integration="consistent" dynamics="transient" duration="2"
         gravity="0 -9.81 0"/></scene>)"));
  expect_parts(text, {"tissue 1 (brain): ogden, mu, alpha 842,-4.7, nu 0.49, relaxes to mu 155.77 Pa", "dilatation 1.6",
                      "volumetric: pointwise\n", "integration: consistent",
                      "dynamics: transient over 2 s, time step automatic", "gravity: 0 -9.81 0 m/s2"});
}

TEST_F(SceneFile, ExplainSaysWhenEachCutBegins) {
  const std::string text = explain_scene(parse(R"(<scene>
  <cuts contact="yes"><cut file="a.vtp"/><cut file="b.vtp" start="0.5"/>
    <cut file="c.vtp" speed="40" direction="0 0 -1"/></cuts>
  <resection labels="2 3" pressure="50"/></scene>)"));
  expect_parts(text, {"cuts: active, named in ", "resection: active", "a.vtp: from the start, or as its file says\n",
                      "b.vtp: at time 0.5\n", "c.vtp: from time 0 on, 40 mm in a unit of it along 0 0 -1\n",
                      "faces of cuts: in contact", "resection: labels 2 3, pressure in the cavity 50 Pa"});
  expect_parts(explain_scene(parse("<scene/>")), {"cuts: not built", "resection: not built"});
}

}  // namespace brainshift::pipelines::explain_scene_test
