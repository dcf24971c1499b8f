// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/check_scene.hpp"

#include <gtest/gtest.h>

#include "tests/unit/pipelines/scene_file.hpp"

namespace brainshift::pipelines::check_scene_test {

TEST_F(SceneFile, CheckRefusesWhatParsingCannotSee) {
  write_image(folder_ / "labels.nii.gz", block_labels());
  write_load();
  const std::string load = "<load><craniotomy file=\"load.csv\"/></load>";
  const std::string image = "<image labels=\"labels.nii.gz\"/>";
  const std::string two = "<tissues><tissue label=\"1\"/><tissue label=\"3\"/></tissues>";
  const auto scene = [](const std::string& inside) { return "<scene>\n" + inside + "\n</scene>"; };
  EXPECT_EQ(fault(scene(image + two + load)), "");
  expect_parts(fault(scene("<image labels=\"none.nii\"/>" + two + load)),
               {"scene.xml:2", "none.nii", "does not exist"});
  expect_parts(fault(scene(two + load)), {"exactly one"});
  expect_parts(fault(scene("<image labels=\"labels.nii.gz\" surface=\"load.csv\"/>" + two + load)), {"exactly one"});
  expect_parts(fault(scene("<image brain_mask=\"labels.nii.gz\"/>" + two + load)), {"t1"});
  expect_parts(fault(scene(image + two)), {"no <load>"});
  expect_parts(fault(scene(image + two + "<load/>")), {"exactly one"});
  expect_parts(fault(scene(image + load)), {"scene.xml:2", "1 3 6", "not FreeSurfer's", "no <tissues>"});
  expect_parts(fault(scene("<image labels=\"labels.nii.gz\" labels_are=\"freesurfer\"/>" + two + load)),
               {"named by class"});
  expect_parts(fault(scene("<image labels=\"labels.nii.gz\" labels_are=\"t.ctbl\"/>" + load)), {"t.ctbl"});
  expect_parts(fault(scene("<image labels=\"labels.nii.gz\" tumour=\"labels.nii.gz\" tumour_mask=\"labels.nii.gz\"/>" +
                           two + load)),
               {"give one of them"});
  for (const std::string asked : {"robust=\"yes\"", "registration=\"unknown\"", "weight=\"0.1\""}) {
    std::string without = load;
    without.replace(0, 5, "<load " + asked);
    expect_parts(fault(scene(image + two + without)), {"how well the points were measured", "a noise"});
  }
  for (const std::string asked : {"robust=\"yes\"", "registration=\"unknown\""}) {
    std::string noisy = load;
    noisy.replace(0, 5, "<load noise=\"0.5\" " + asked);
    const std::string drained = "<contact/><gravity direction=\"0 0 -1\" drained=\"40\"/>";
    EXPECT_EQ(fault(scene(image + two + noisy + "<contact/>")), "");
    expect_parts(fault(scene(image + two + noisy + drained)), {asked, "does not go with gravity", "leave the one"});
  }
  const std::string tumour = "<image labels=\"labels.nii.gz\" other_labels=\"6";
  expect_parts(fault(scene(tumour + "\" tumour=\"labels.nii.gz\"/>" + two + load)),
               {"label 3", "labels.nii.gz has already", "another number"});
  EXPECT_EQ(fault(scene(tumour + "\" tumour=\"labels.nii.gz\"/>" + load +
                        "<tissues><tissue label=\"1\"/><tissue label=\"3\" material=\"tumour\"/></tissues>")),
            "");
  expect_parts(fault(scene(tumour + " 3\" tumour=\"labels.nii.gz\"/><tissues><tissue label=\"1\"/></tissues>" + load)),
               {"label 3", "other_labels"});
  const std::string mixed = "<tissues><tissue label=\"1\"/><tissue class=\"tumour\"/></tissues>";
  expect_parts(fault(scene(image + mixed + load)), {"by class, others by label"});
  EXPECT_EQ(fault(scene(image + "<tissues><tissue labels=\"1-4\"/></tissues>" + load)), "");
  expect_parts(fault(scene(image + load + "<tissues>\n<tissue label=\"1\"/>\n<tissue label=\"2\"/></tissues>")),
               {"scene.xml:4", "tissue 2", "1 3 6"});
  expect_parts(fault(scene(image + load + "<tissues><tissue label=\"1\"/></tissues>")),
               {"label 3", "no material", "other_labels"});
  expect_parts(fault(scene(image + two + load), {"discretise.nodes=100", "discretise.spacing=3"}), {"both"});
  expect_parts(fault(scene(image + two + load), {"solve.points_per_cell=4"}), {"--set", "hexahedra take 1 or 8"});
  expect_parts(fault(scene(image + two + load), {"image.skull_label=5"}), {"--set", "skull_label 5"});
  expect_parts(fault(scene(image + two + load), {"solve.damping=1"}), {"--set", "damping", "relaxation", "transient"});
  expect_parts(fault(scene(image + two + load), {"solve.curve_join=straight"}), {"--set", "no curve"});
  expect_parts(fault(scene(image + two + load), {"tissues.3.law=ogden"}), {"scene.xml:2", "label 3", "no terms"});
  expect_parts(fault(scene(image + two + load), {"tissues.3.ogden=1,2"}), {"scene.xml:2", "1,2", "law neo_hookean"});
  const std::string soft = "tissues.3.youngs_modulus=9", ogden = "tissues.3.material=brain_ogden";
  expect_parts(fault(scene(image + two + load), {ogden, soft}), {"--set", "tissues.3", "ogden", "change nothing"});
  EXPECT_EQ(
      fault(scene(image + load + "<tissues><tissue label=\"1\"/><tissue label=\"3\" youngs_modulus=\"9\"/></tissues>"),
            {ogden}),
      "")
      << "the command line sets all anew";
  for (const std::string own : {"skull_label", "other_labels"}) {
    expect_parts(fault(scene("<image labels=\"labels.nii.gz\" labels_are=\"freesurfer\" " + own + "=\"6\"/>" + load)),
                 {"scene.xml:2", own, "named by class", "leave it out"});
  }
  std::ofstream(folder_ / "curve.csv") << "time,factor\n0,0\n2,1\n";
  EXPECT_EQ(fault(scene(image + two + load), {"solve.curve=curve.csv"}), "");
  expect_parts(
      fault(scene(image + two + load), {"solve.curve=curve.csv", "solve.dynamics=transient", "solve.duration=2"}),
      {"--set", "duration", "curve.csv"});
}

TEST_F(SceneFile, WithoutALoadThePressureInACavityMoves) {
  write_image(folder_ / "labels.nii.gz", block_labels());
  const auto fault_of = [&](const std::string& more) {
    return fault("<scene>\n<image labels=\"labels.nii.gz\"/><tissues><tissue label=\"1\"/><tissue label=\"3\"/>" +
                 ("</tissues>" + more) + "</scene>");
  };
  const std::string pressed = "<resection labels=\"3\" pressure=\"500\"/>";
  EXPECT_EQ(fault_of("<contact/>" + pressed), "");
  expect_parts(fault_of(pressed), {"neither <load> nor <contact>", "the pressure in the cavity", "add <contact/>"});
  expect_parts(fault_of("<contact/><resection labels=\"3\"/>"), {"no <load>", "nothing would move"});
}

TEST_F(SceneFile, CheckRefusesWhatLateStagesWouldFindWrong) {
  write_image(folder_ / "labels.nii.gz", block_labels());
  ScalarImage t1{block_labels().geometry, std::vector<float>(64, 1)};
  write_image(folder_ / "t1.nii.gz", t1);
  t1.geometry.spacing.setConstant(6);
  write_image(folder_ / "coarse.nii.gz", t1);
  std::ofstream(folder_ / "prose.nii") << "this is no image";
  write_load();
  const auto fault_of = [&](const std::string& image, const std::string& more, const std::string& load = "load.csv") {
    return fault("<scene>\n<image " + image + " labels=\"labels.nii.gz\"/><tissues><tissue label=\"1\"/>" +
                 "<tissue label=\"3\"/></tissues>\n<load><craniotomy file=\"" + load + "\"/></load>\n" + more +
                 "</scene>");
  };
  EXPECT_EQ(fault_of("t1=\"t1.nii.gz\"", ""), "");
  expect_parts(fault_of("t1=\"prose.nii\"", ""), {"scene.xml:2", "prose.nii"});
  expect_parts(fault_of("t1=\"coarse.nii.gz\"", ""), {"scene.xml:2", "fade", "two voxel diagonals"});
  EXPECT_EQ(fault_of("t1=\"coarse.nii.gz\"", "<stage name=\"register\" fade=\"40\"/>"), "");
  std::ofstream(folder_ / "bad.csv") << "# frame: LPS\nx,y,z,ux,uy,uz\n1,1,1,0,0,two\n";
  expect_parts(fault_of("", "", "bad.csv"), {"scene.xml:3", "bad.csv:3", "two"});
  expect_parts(fault_of("", "<landmarks file=\"prose.nii\"/>"), {"scene.xml:4", "prose.nii"});
  const std::string far(300, 'a');
  expect_parts(fault_of("t1=\"" + far + "\"", ""), {"scene.xml:2", "cannot be reached"});
}

TEST_F(SceneFile, ARegionDoesNotGoWithGravity) {
  write_image(folder_ / "labels.nii.gz", block_labels());
  write_load();
  const std::string scene = R"(<scene><image labels="labels.nii.gz"/>
  <tissues><tissue label="1"/><tissue label="3"/></tissues>
  <load><craniotomy file="load.csv"/></load><stage name="solve" region="1"/></scene>)";
  EXPECT_EQ(fault(scene), "");
  expect_parts(fault(scene, {"solve.gravity=0 0 -9.81"}), {"region", "gravity"});
}

}  // namespace brainshift::pipelines::check_scene_test
