// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/read_sequence.hpp"

#include <gtest/gtest.h>

#include "tests/unit/pipelines/scene_file.hpp"

namespace brainshift::pipelines::read_sequence_test {

class Sequence : public SceneFile {
 protected:
  /// A scene with what stands in its <sequence>.
  static std::string scene_of(const std::string& states) {
    return R"(<scene version="1">
<image surface="ball.vtp"/>
<tissues><tissue label="1" material="brain"/><tissue label="3" material="tumour"/></tissues>
<load margin="3"><craniotomy file="load.csv"/></load>
<contact/>
<sequence>)" +
           states + "</sequence></scene>";
  }
  static constexpr const char* operation = R"(
<state name="opened"/>
<state name="drained"><gravity direction="0 1 0" drained="30"/></state>
<state name="resected"><load><craniotomy file="again.csv"/></load><resection labels="3" pressure="5"/></state>
<state name="more"><gravity direction="0 1 0" fluid_level="4"/><resection labels="1"/>
  <tissues><tissue label="1" swelling="0.05"/></tissues></state>)";
};

TEST_F(Sequence, EachStateIsTheOneBeforeItWithWhatItChanges) {
  const Scene scene = parse(scene_of(operation));
  ASSERT_EQ(scene.states.size(), 4U);
  const Scene &opened = scene.states[0], &drained = scene.states[1], &resected = scene.states[2],
              &more = scene.states[3];
  EXPECT_FALSE(scene.gravity);
  EXPECT_FALSE(opened.gravity);
  EXPECT_EQ(opened.state->before, "");
  EXPECT_EQ(drained.state->name, "drained");
  EXPECT_EQ(drained.state->before, "opened");
  EXPECT_EQ(drained.gravity->drained, 30);
  EXPECT_EQ(drained.load->opening.margin, 3) << "as the scene has it";
  EXPECT_EQ(*resected.load->craniotomy, folder_ / "again.csv");
  EXPECT_EQ(resected.load->opening.margin, Load{}.opening.margin) << "an element comes anew as a whole";
  EXPECT_EQ(resected.gravity->drained, 30);
  EXPECT_EQ(resected.resection->labels, std::vector<std::int32_t>{3});
  EXPECT_FALSE(more.gravity->drained);
  EXPECT_EQ(more.gravity->fluid_level, 4);
  EXPECT_EQ(more.resection->labels, (std::vector<std::int32_t>{3, 1})) << "what is out stays out";
  EXPECT_EQ(more.resection->pressure, 0);
  EXPECT_EQ(more.tissues[0].material.swelling, 0.05);
  EXPECT_EQ(more.tissues[0].material.youngs_modulus, resected.tissues[0].material.youngs_modulus);
  EXPECT_TRUE(more.contact);
}

TEST_F(Sequence, OverridesReachIntoAState) {
  const Scene scene =
      parse(scene_of(operation), {"sequence.drained.gravity.drained=50", "load.margin=4", "discretise.nodes=500"});
  EXPECT_EQ(scene.states[1].gravity->drained, 50);
  EXPECT_EQ(scene.states[2].gravity->drained, 50) << "it goes on from there";
  EXPECT_EQ(scene.states[1].load->opening.margin, 4);
  EXPECT_EQ(scene.states[3].discretise.nodes, 500U);
  expect_parts(fault(scene_of(operation), {"sequence.closed.gravity.drained=50"}), {"opened, drained, resected, more"});
  expect_parts(fault(scene_of(operation), {"sequence.drained.segment.edge_length=4"}), {"a state may change load"});
}

TEST_F(Sequence, WhatIsWrongIsSaidWithItsLine) {
  struct Wrong {
    const char* states;
    std::vector<std::string> said;
  };
  const std::vector<Wrong> all = {
      {"", {"scene.xml:6", "names no state"}},
      {"<step name=\"a\"/>", {"<sequence> has no element <step>", "allowed: state"}},
      {"<state/>", {"takes the attribute 'name'"}},
      {"<state name=\"a\" time=\"1\"/>", {"takes the attribute 'name' and no other"}},
      {"<state name=\"../a\"/>", {"'../a'", "letters, digits"}},
      {"<state name=\"\"/>", {"the state's name is ''"}},
      {"<state name=\"a\"/>\n<state name=\"a\"><gravity direction=\"0 1 0\" drained=\"3\"/></state>",
       {"scene.xml:7", "two states 'a'"}},
      {"<state name=\"a\"/><state name=\"b\"/>", {"'b' changes nothing"}},
      {"<state name=\"a\"><stage name=\"segment\"/></state>", {"cannot change <stage>", "load, gravity"}},
      {"<state name=\"a\"><stage name=\"discretise\" nodes=\"9\"/></state>", {"cannot change <stage>"}},
      {"<state name=\"a\"><image t1=\"other.nii\"/></state>", {"cannot change <image>"}},
      {"<state name=\"a\"><drain/></state>", {"cannot change <drain>"}},
      {"<state name=\"a\"><gravity drained=\"3\"/></state>", {"<gravity> needs the attribute 'direction'"}},
      {"<state name=\"a\"><resection labels=\"3\"/><resection labels=\"1\"/></state>", {"changes <resection> twice"}},
      {"<state name=\"a\"><tissues><tissue label=\"7\" swelling=\"0.1\"/></tissues></state>", {"none of label 7"}},
      {"<state name=\"a\">drained</state>", {"holds the text 'drained'"}}};
  for (const Wrong& wrong : all) {
    const std::string said = fault(scene_of(wrong.states));
    EXPECT_NE(said, "") << wrong.states;
    expect_parts(said, wrong.said);
  }
  expect_parts(fault("<scene><sequence/><sequence/></scene>"), {"is there twice"});
}

TEST_F(Sequence, AStateIsCheckedAsASceneIs) {
  write_load();
  std::ofstream(folder_ / "ball.vtp") << "";
  expect_parts(fault(scene_of("<state name=\"b\"><load><craniotomy file=\"none.csv\"/></load></state>")),
               {"none.csv", "does not exist", "(state 'b')"});
  expect_parts(fault(scene_of("<state name=\"a\"/>"), {"solve.dynamics=transient"}), {"from one state of rest"});
}

}  // namespace brainshift::pipelines::read_sequence_test
