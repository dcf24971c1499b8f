// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/parse_scene.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "pipelines/scene/describe_scene.hpp"
#include "tests/unit/pipelines/scene_file.hpp"

namespace brainshift::pipelines::parse_scene_test {

TEST_F(SceneFile, ValuesArriveWhereTheyBelong) {
  const Scene scene = parse(R"(<scene version="1">
  <image t1="t1.nii" other_labels="4 7" skull_label="5"/>
  <tissues><tissue label="2" name="ventricles" youngs_modulus="10" poisson_ratio="0.1" density="900"/></tissues>
  <load margin="3"><simulated centre="1 -2 3.5" radius="20" depth="6"/></load>
  <contact/>
  <stage name="discretise" spacing="4" cells="tetrahedra" craniotomy_factor="0.5"/>
  <stage name="solve" basis="linear" points_per_cell="4" command="my_solver {in} {out}"/>
  <stage name="register" interpolation="bspline"/>
</scene>)");
  EXPECT_EQ(scene.image.t1, folder_ / "t1.nii") << "files are relative to the scene's";
  EXPECT_EQ(scene.image.other_labels, (std::vector<std::uint16_t>{4, 7}));
  EXPECT_EQ(scene.image.skull_label, 5);
  EXPECT_EQ(scene.tissues.at(0).material.density, 900);
  EXPECT_EQ(scene.load->opening.margin, 3);
  EXPECT_EQ(scene.load->simulated->centre, Eigen::Vector3d(1, -2, 3.5));
  EXPECT_TRUE(scene.contact);
  EXPECT_EQ(scene.discretise.spacing, 4);
  EXPECT_EQ(scene.discretise.cells, CellKind::tetrahedron);
  EXPECT_EQ(scene.refinement.factor, 0.5);
  EXPECT_EQ(scene.solve.shape.basis, Basis::linear);
  EXPECT_EQ(scene.solve.points_per_cell, 4);
  EXPECT_EQ(scene.commands[index_of(StageId::solve)], "my_solver {in} {out}");
  EXPECT_EQ(scene.registration.interpolation, registration::Interpolation::bspline);
}

TEST_F(SceneFile, MaterialsComeByNameThenByTheConstantsBesideIt) {
  const Scene scene = parse(R"(<scene>
  <tissues>
    <tissue label="1" poisson_ratio="0.45" material="brain_viscoelastic"/>
    <tissue label="2" law="ogden" ogden="842,-4.7; 10,2" prony="0.2,0.5"/>
    <tissue label="3" law="saint_venant_kirchhoff" youngs_modulus="500"/>
    <tissue label="4" material="brain_ogden"/>
  </tissues></scene>)",
                            {"tissues.4.material=tumour", "tissues.4.density=1100"});
  const solve::Material& named = scene.tissues.at(0).material;
  EXPECT_EQ(named.law, solve::Law::ogden);
  EXPECT_EQ(named.poisson_ratio, 0.45) << "whatever the order of the attributes";
  EXPECT_EQ(named.prony.size(), 2U);
  const solve::Material& terms = scene.tissues.at(1).material;
  ASSERT_EQ(terms.ogden.size(), 2U);
  EXPECT_EQ(terms.ogden[0].exponent, -4.7);
  EXPECT_EQ(terms.ogden[1].shear_modulus, 10);
  EXPECT_EQ(terms.prony.at(0).time, 0.5);
  EXPECT_EQ(scene.tissues.at(2).material.law, solve::Law::saint_venant_kirchhoff);
  EXPECT_EQ(scene.tissues.at(3).material.youngs_modulus, 9000);
  EXPECT_EQ(scene.tissues.at(3).material.density, 1100);
}

TEST_F(SceneFile, ThePhysicsOfTheSolveStageArrives) {
  const Scene scene = parse(R"(<scene>
  <stage name="solve" integration="consistent" integration_tolerance="0.3" integration_depth="2"
         nodes_per_patch="8" imposition="simplified" dynamics="transient"
         time_step="0.001" damping="2" duration="3" curve_join="straight" gravity="0,0,-9.81" points_per_cell="3"/>
  </scene>)");
  EXPECT_EQ(scene.solve.integration, solve::Integration::consistent);
  EXPECT_EQ(scene.solve.nodes_per_patch, 8);
  EXPECT_EQ(scene.solve.integration_tolerance, 0.3);
  EXPECT_EQ(scene.solve.integration_depth, 2);
  EXPECT_EQ(scene.solve.imposition, solve::Imposition::simplified);
  EXPECT_EQ(scene.solve.dynamics, solve::Dynamics::transient);
  EXPECT_EQ(scene.solve.time_step, 0.001);
  EXPECT_EQ(scene.solve.damping, 2);
  EXPECT_EQ(load_curve(scene.loading).duration(), 3);
  EXPECT_EQ(scene.loading.curve_join, solve::LoadCurve::Join::straight);
  EXPECT_EQ(scene.loading.gravity, Eigen::Vector3d(0, 0, -9.81));
  EXPECT_EQ(scene.solve.points_per_cell, 3);
}

TEST_F(SceneFile, WhatLiesBeforeAndAfterArrivesAsSuch) {
  const Scene surfaces = parse("<scene><load><surfaces before=\"a.vtp\" after=\"b.vtp\"/></load></scene>");
  EXPECT_EQ(surfaces.load->surfaces->before, folder_ / "a.vtp");
  EXPECT_EQ(surfaces.load->surfaces->after, folder_ / "b.vtp");
  const Scene markups = parse("<scene><load><markups before=\"a.fcsv\" after=\"b.fcsv\"/></load></scene>");
  EXPECT_EQ(markups.load->markups->before, folder_ / "a.fcsv");
  EXPECT_EQ(markups.load->markups->after, folder_ / "b.fcsv");
}

TEST_F(SceneFile, CutsAndResectionArrive) {
  const Scene scene = parse(R"(<scene>
  <cuts contact="yes">
    <cut file="corpus.vtp"/>
    <cut file="sulcus.stl" start="0.25" speed="40" direction="0 -1 2"/>
  </cuts>
  <resection labels="2 3" pressure="120"/></scene>)");
  EXPECT_TRUE(scene.cuts->contact);
  ASSERT_EQ(scene.cuts->files.size(), 2U);
  EXPECT_EQ(scene.cuts->files[0].file, folder_ / "corpus.vtp") << "files are relative to the scene's";
  EXPECT_FALSE(scene.cuts->files[0].timing.start);
  EXPECT_EQ(scene.cuts->files[1].timing.start, 0.25);
  EXPECT_EQ(scene.cuts->files[1].timing.speed, 40);
  EXPECT_EQ(scene.cuts->files[1].timing.direction, Eigen::Vector3d(0, -1, 2));
  EXPECT_EQ(scene.resection->labels, (std::vector<std::int32_t>{2, 3}));
  EXPECT_EQ(scene.resection->pressure, 120);
  const auto options = effective_options(scene);
  EXPECT_EQ(options["cuts"]["contact"], "yes");
  EXPECT_EQ(options["cuts"]["2"]["speed"], "40");
}

TEST_F(SceneFile, PartsThatAreNotNamedAreNotThere) {
  const Scene scene = parse("<scene/>");
  EXPECT_FALSE(scene.load);
  EXPECT_FALSE(scene.contact);
  EXPECT_FALSE(scene.landmarks);
  EXPECT_FALSE(scene.cuts);
  EXPECT_FALSE(scene.resection);
  EXPECT_TRUE(scene.tissues.empty());
  EXPECT_FALSE(effective_options(scene).contains("cuts"));
  EXPECT_FALSE(effective_options(scene).contains("resection"));
}

TEST_F(SceneFile, TissuesHaveALabelSeveralOrAClass) {
  const Scene listed = parse("<scene><tissues><tissue labels=\"3 10-12\" density=\"900\"/></tissues></scene>",
                             {"tissues.3.youngs_modulus=50"});
  EXPECT_EQ(listed.tissues.at(0).label, 3);
  EXPECT_EQ(listed.tissues.at(0).labels, (std::vector<std::uint16_t>{3, 10, 11, 12}));
  EXPECT_EQ(listed.tissues.at(0).material.youngs_modulus, 50);
  EXPECT_EQ(listed.source.lines.at("tissues.3.density"), 1);

  const Scene by_class = parse(
      "<scene><image labels=\"a.nii\"/><tissues><tissue class=\"ventricles\" youngs_modulus=\"20\"/></tissues></scene>",
      {"tissues.3.density=1100"});
  ASSERT_EQ(by_class.tissues.size(), 3U);
  EXPECT_EQ(by_class.tissues[0].label, 2);
  EXPECT_EQ(by_class.tissues[0].material.youngs_modulus, 20);
  EXPECT_EQ(by_class.tissues[1].label, 1);
  EXPECT_EQ(by_class.tissues[1].material.youngs_modulus, 3000);
  EXPECT_EQ(by_class.tissues[2].material.youngs_modulus, 9000);
  EXPECT_EQ(by_class.tissues[2].material.density, 1100);
  EXPECT_TRUE(parse("<scene><image surface=\"a.stl\"/></scene>").tissues.empty());
  EXPECT_EQ(parse("<scene><image labels=\"a.nii\" labels_are=\"freesurfer\"/></scene>").image.labels_are, "freesurfer");
  EXPECT_EQ(parse("<scene><image labels=\"a.nii\" labels_are=\"t.ctbl\"/></scene>").image.labels_are,
            folder_ / "t.ctbl");
}

TEST_F(SceneFile, SetOverridesTheFile) {
  const Scene scene = parse(R"(<scene>
  <tissues><tissue label="1" youngs_modulus="3000"/></tissues>
  <stage name="segment" edge_length="5"/></scene>)",
                            {"segment.edge_length=4", "tissues.1.youngs_modulus=2500", "load.craniotomy.file=c.csv"});
  EXPECT_EQ(scene.segment.edge_length, 4);
  EXPECT_EQ(scene.tissues.at(0).material.youngs_modulus, 2500);
  EXPECT_EQ(*scene.load->craniotomy, folder_ / "c.csv");
}

TEST_F(SceneFile, FaultsNameFileAndLineAndWhatIsAllowed) {
  const std::string at = folder_.string() + "/scene.xml:";
  struct Case {
    std::string inside;  // from line 2 on
    std::vector<std::string> parts;
  };
  const std::vector<Case> cases = {
      {"\n<imgae/>", {at + "3", "imgae", "image, load, contact"}},
      {"<image t2=\"x\"/>", {at + "2", "t2", "t1, labels"}},
      {"<image\n t1=\"a\"\n t1=\"b\"/>", {"scene.xml"}},
      {"<image/>\n<image/>", {at + "3", "twice"}},
      {"<stage name=\"segmnet\"/>", {at + "2", "segmnet", "segment, discretise"}},
      {"<stage/>", {at + "2", "name"}},
      {"<stage name=\"segment\"\n edge_length=\"-1\"/>", {at + "3", "edge_length", "'-1'", ">= 0.5", "mm"}},
      {"<stage name=\"segment\" edge_length=\"nan\"/>", {at + "2", "'nan'", ">= 0.5"}},
      {"<stage name=\"segment\" edge_length=\"5mm\"/>", {at + "2", "'5mm'", ">= 0.5"}},
      {"<stage name=\"segment\" classes=\"2.5\"/>", {at + "2", "'2.5'", "whole number from 2 to 10"}},
      {"<stage name=\"solve\" basis=\"cubic\"/>", {at + "2", "'cubic'", "linear | quadratic | modified_quadratic"}},
      {"<tissues><tissue label=\"1\" poisson_ratio=\"0.5\"/></tissues>", {at + "2", "'0.5'", "< 0.5"}},
      {"<tissues><tissue label=\"1\" ogden=\"842\"/></tissues>", {at + "2", "'842'", "pairs mu,alpha", "Pa"}},
      {"<tissues><tissue label=\"1\" prony=\"1;2\"/></tissues>", {at + "2", "'1;2'", "pairs share,time"}},
      {"<tissues><tissue label=\"1\" material=\"bran\"/></tissues>", {at + "2", "'bran'", "brain | brain_ogden"}},
      {"<stage name=\"solve\" gravity=\"1,2\"/>", {at + "2", "'1,2'", "three numbers", "m/s2"}},
      {"<stage name=\"solve\" nodes_per_patch=\"0\"/>", {at + "2", "'0'", "> 0"}},
      {"<stage name=\"solve\" integration_tolerance=\"-1\"/>", {at + "2", "'-1'", "0"}},
      {"<stage name=\"solve\" duration=\"0\"/>", {at + "2", "'0'", "> 0"}},
      {"<tissues><tissue name=\"a\"/></tissues>", {at + "2", "needs one of the attributes 'label'", "'class'"}},
      {"<tissues>\n<tissue label=\"1\"/>\n<tissue label=\"1\"/></tissues>", {at + "4", "two tissues of label 1"}},
      {"<tissues><tissue labels=\"1 2\"/>\n<tissue labels=\"3 2\"/></tissues>", {at + "3", "two tissues of label 2"}},
      {"<tissues><tissue labels=\"1 2\"/>\n<tissue label=\"2\"/></tissues>", {at + "3", "two tissues of label 2"}},
      {"<tissues><tissue label=\"1\" class=\"tumour\"/></tissues>", {at + "2", "needs one of"}},
      {"<tissues><tissue labels=\"\"/></tissues>", {at + "2", "no label and no class"}},
      {"<tissues><tissue labels=\"9-2\"/></tissues>", {at + "2", "'9-2'", "10-13 is 10 11 12 13"}},
      {"<tissues><tissue class=\"skin\"/></tissues>", {at + "2", "'skin'", "parenchyma | ventricles | tumour"}},
      {"<tissues><organ/></tissues>", {at + "2", "organ", "tissue"}},
      {"<load><simulated centre=\"1 2\"/></load>", {at + "2", "'1 2'", "three numbers"}},
      {"<load><craniotomy/></load>", {at + "2", "needs the attribute 'file'"}},
      {"<contact>now</contact>", {at + "2", "text 'now'"}},
      {"<cuts>\n<cut/></cuts>", {at + "3", "<cut> needs the attribute 'file'"}},
      {"<cuts>\n<cut path=\"0,0; 1,1\"/></cuts>", {at + "3", "path", "brainshift solve --plane", "sheet"}},
      {"<cuts><cut file=\"a.vtp\" end=\"1\"/></cuts>", {at + "2", "<cut>", "'end'", "file, start, speed, direction"}},
      {"<cuts><cut file=\"a.vtp\" start=\"-1\"/></cuts>", {at + "2", "start", "'-1'", ">= 0"}},
      {"<cuts><cut file=\"a.vtp\" speed=\"0\"/></cuts>", {at + "2", "speed", "'0'", "> 0", "mm"}},
      {"<cuts><cut file=\"a.vtp\" direction=\"1\"/></cuts>", {at + "2", "direction", "'1'", "three numbers"}},
      {"<cuts contact=\"maybe\"/>", {at + "2", "contact", "'maybe'", "no | yes"}},
      {"<cuts><slit/></cuts>", {at + "2", "<cuts> has no element <slit>", "allowed: cut"}},
      {"<cuts>here</cuts>", {at + "2", "text 'here'"}},
      {"<cuts/>\n<cuts/>", {at + "3", "twice"}},
      {"<resection/>", {at + "2", "needs the attribute 'labels'"}},
      {"<resection labels=\"two\"/>", {at + "2", "labels", "'two'", "whole numbers from 1 to 65535"}},
      {"<resection labels=\"2\" pressure=\"high\"/>", {at + "2", "pressure", "'high'", "Pa"}},
      {"<segment edge_length=\"3\"/>", {at + "2", "segment"}},
      {"<image>", {at, "XML"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.inside);
    expect_parts(fault("<scene version=\"1\">\n" + c.inside + "</scene>"), c.parts);
  }
  expect_parts(fault("<model/>"), {at + "1", "<scene version=\"1\">"});
  expect_parts(fault("<scene version=\"2\"/>"), {at + "1", "version"});
  expect_parts(fault(""), {"scene.xml", "empty"});
  expect_parts(fault("<scene/>\n<scene/>"), {"scene.xml:2", "beside the <scene>"});
  expect_parts(fault("text\n<scene/>"), {"scene.xml:1", "beside the <scene>"});
  expect_parts(fault("<scene/>\nand more"), {"scene.xml:2", "well-formed"});
  expect_parts(fault("<scene>\n<image t1=\"&#0;\"/></scene>"), {"scene.xml:2", "character of number 0"});
  expect_parts(fault("<scene>\n<image t1=\"&#x00;t1.nii\"/></scene>"), {"scene.xml:2", "character of number 0"});
  expect_parts(fault("<scene>\n<image t1=\"t&#27;[1.nii\"/></scene>"), {"scene.xml:2", "control character"});
}

TEST_F(SceneFile, ALongRowOfZerosIsNoCharacterAndNoEndOfTheProgram) {
  EXPECT_NO_THROW(parse("<scene>\n<!-- &#" + std::string(400000, '0') + " &#x &# &#01; --></scene>"));
  expect_parts(fault("<scene>\n<!-- &#x" + std::string(400000, '0') + "; --></scene>"), {"scene.xml:2", "number 0"});
}

/// As the system has it: the folder above the one that the link leads to.
TEST_F(SceneFile, TheFolderAboveALinkIsThatOfTheFolderItLeadsTo) {
  namespace fs = std::filesystem;
  fs::create_directories(folder_ / "real/deep");
  fs::create_directories(folder_ / "top");
  fs::create_directory_symlink(folder_ / "real/deep", folder_ / "top/link");
  std::ofstream(folder_ / "top/link/s.xml") << "<scene><image t1=\"../t1.nii\" labels=\"l.nii\"/></scene>";
  const Scene scene = parse_scene(folder_ / "top/link/s.xml", {});
  EXPECT_EQ(scene.image.t1, fs::canonical(folder_) / "real/t1.nii");
  EXPECT_EQ(scene.image.labels, folder_ / "top/link/l.nii") << "other links keep their names";
}

TEST_F(SceneFile, FaultsOfOverridesNameThePath) {
  expect_parts(fault("<scene/>", {"segment.edge=4"}), {"--set", "edge", "edge_length"});
  expect_parts(fault("<scene/>", {"segmentation.edge_length=4"}), {"--set", "segmentation", "segment"});
  expect_parts(fault("<scene/>", {"segment.edge_length=0"}), {"--set", "'0'", ">= 0.5"});
  expect_parts(fault("<scene/>", {"segment.edge_length"}), {"--set", "PATH=VALUE"});
  expect_parts(fault("<scene/>", {"tissues.3.density=1"}), {"--set", "no tissue of label '3'"});
  expect_parts(fault("<scene/>", {"load.simulated.depth=4"}), {"--set", "load.simulated.centre"});
  expect_parts(fault("<scene/>", {"cuts.1.speed=4"}), {"--set", "cuts.1", "cuts, septa, septum, resection"});
  expect_parts(fault("<scene/>", {"resection.pressure=4"}), {"--set", "resection.labels"});
}

}  // namespace brainshift::pipelines::parse_scene_test
