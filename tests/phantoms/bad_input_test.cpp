// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bad input through the program: each ends with the right code and one sentence, and leaves nothing half-written.
#include <limits>

#include "segmentation/files/surface_file.hpp"
#include "segmentation/geometry/surface.hpp"
#include "tests/phantoms/bad_input.hpp"

namespace brainshift::bad_input_test {

using namespace bad_input;

TEST_F(BadInput, TheBallItselfRuns) {
  const ProgramResult result = run_shell(run_scene("scene.xml"));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
}

TEST_F(BadInput, FilesThatAreMissingEmptyTruncatedOrNoImage) {
  write_text(at("empty.nii.gz"), "");
  write_text(at("text.nii.gz"), "this is no image\n");
  write_text(at("text.nii"), "this is no image\n");
  const std::string whole = bytes_of(at("labels.nii.gz"));
  write_text(at("truncated.nii.gz"), whole.substr(0, whole.size() / 2));
  for (const std::string file : {"missing.nii.gz", "empty.nii.gz", "text.nii.gz", "text.nii", "truncated.nii.gz"}) {
    expect_refused("brainshift segment --quiet --brain-labels 1 --labels " + at(file) + " --out " + at("out"), {file});
    write_scene("bad.xml", "t1.nii.gz", file, "<craniotomy file=\"load.csv\"/>");
    expect_refused(run_scene("bad.xml"), {file});
    write_scene("bad.xml", file, "labels.nii.gz", "<craniotomy file=\"load.csv\"/>");
    expect_refused(run_scene("bad.xml"), {file});
  }
  for (const std::string file : {"empty.vtp", "text.stl", "text.vtu"}) {
    write_text(at(file), file == "empty.vtp" ? "" : "this is no surface\n");
  }
  expect_refused("brainshift segment --quiet --surface " + at("empty.vtp") + " --out " + at("out"), {"empty.vtp"});
  expect_refused("brainshift discretise --quiet --surface " + at("text.stl") + " --out " + at("out"), {"text.stl"});
  expect_refused("brainshift solve --quiet --nodes " + at("text.vtu") + " --cells " + at("ball/cells.vtu") +
                     " --material 1:3000,0.45 --out " + at("out"),
                 {"text.vtu"});
}

TEST_F(BadInput, LabelsThatLieBesideTheT1) {
  LabelMap moved = ball_labels();
  moved.geometry.origin.x() += 1000;
  write_image(at("moved.nii.gz"), moved);
  write_scene("bad.xml", "t1.nii.gz", "moved.nii.gz", "<craniotomy file=\"load.csv\"/>");
  expect_refused(run_scene("bad.xml"), {"moved.nii.gz", "t1.nii.gz", "one patient"});
}

TEST_F(BadInput, ATissueThatTheImageLacksAndALabelWithoutMaterial) {
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"load.csv\"/>",
              "<tissue label=\"1\"/>\n<tissue label=\"9\"/>");
  expect_refused(run_scene("bad.xml"), {"bad.xml:4", "tissue 9", "labels.nii.gz"});
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"load.csv\"/>", "<tissue label=\"9\"/>");
  expect_refused(run_scene("bad.xml"), {"bad.xml:3", "9"});
  expect_refused("brainshift solve --quiet --nodes " + at("ball/nodes.vtu") + " --cells " + at("ball/cells.vtu") +
                     " --material 9:3000,0.45 --skull " + at("ball/skull.vtp") + " --load " + at("load.csv") +
                     " --out " + at("out"),
                 {"label 1", "material"});
}

TEST_F(BadInput, VoxelsThatAreNoNumbers) {
  ScalarImage t1 = ball_t1();
  t1.at(3, 4, 5) = std::numeric_limits<float>::quiet_NaN();
  write_image(at("nan.nii.gz"), t1);
  write_scene("bad.xml", "nan.nii.gz", "labels.nii.gz", "<craniotomy file=\"load.csv\"/>");
  expect_refused(run_scene("bad.xml"), {"nan.nii.gz"});
}

TEST_F(BadInput, ABrainHalfBeyondTheImagesBorder) {
  write_image(at("border.nii.gz"), ball_labels(14));
  expect_refused("brainshift segment --quiet --brain-labels 1 --edge-length 12 --labels " + at("border.nii.gz") +
                     " --out " + at("out"),
                 {"border"});
}

TEST_F(BadInput, AnOpenOrSelfIntersectingSurface) {
  Surface surface = read_surface(at("ball/brain.vtp"));
  Surface open = surface;
  open.triangles.conservativeResize(open.triangles.rows() - 1, Eigen::NoChange);
  write_surface(at("open.vtp"), open);
  expect_refused("brainshift discretise --quiet --nodes 250 --surface " + at("open.vtp") + " --out " + at("out"),
                 {"open"});
  Surface crossed = surface;
  crossed.vertices.row(0) = 2 * crossed.vertices.colwise().mean() - crossed.vertices.row(0);
  write_surface(at("crossed.vtp"), crossed);
  expect_refused("brainshift discretise --quiet --nodes 250 --surface " + at("crossed.vtp") + " --out " + at("out"),
                 {"intersect"});
}

TEST_F(BadInput, ALoadInTheWrongFrameOrFarFromTheBrain) {
  write_load("ras.csv", "RAS", 0);
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"ras.csv\"/>");
  expect_refused(run_scene("bad.xml"), {"132.1 mm", "RAS"});
  write_load("far.csv", "LPS", 33);
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"far.csv\"/>");
  expect_refused(run_scene("bad.xml"), {"mm", "20"});
}

TEST_F(BadInput, ALoadUnderWhichThereIsNoNode) {
  const double c = grid / 2 * voxel;
  write_text(at("lone.csv"), "# frame: LPS\nx,y,z,ux,uy,uz\n" + std::to_string(c + 0.123) + "," +
                                 std::to_string(c + 0.456) + "," + std::to_string(c + ball_radius + 12) + ",0,0,-1\n");
  expect_refused(solve_ball("--load " + at("lone.csv") + " --margin 0"), {"node"});
  expect_refused(solve_ball(""), {"prescribe"});
}

TEST_F(BadInput, TooFewNodesForASupport) {
  NodeCloud cloud = read_node_cloud(at("ball/nodes.vtu"));
  cloud.positions.conservativeResize(3, Eigen::NoChange);
  cloud.spacing.resize(3);
  cloud.on_surface.resize(3);
  solve::write_nodes(at("three.vtu"), cloud, {.displacement = Points::Zero(3, 3)});
  expect_refused("brainshift solve --quiet --nodes " + at("three.vtu") + " --cells " + at("ball/cells.vtu") +
                     " --material 1:3000,0.45 --out " + at("out"),
                 {"node"});
}

TEST_F(BadInput, ALineThatDoesNotParse) {
  write_load("line.csv", "LPS", 0, "1,2,3,4,five,6\n");
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"line.csv\"/>");
  expect_refused(run_scene("bad.xml"), {"line.csv", "6", "five"});
  write_load("short.csv", "LPS", 0, "1,2,3\n");
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"short.csv\"/>");
  expect_refused(run_scene("bad.xml"), {"short.csv", "6"});
  write_text(at("bad.fcsv"), "# CoordinateSystem = LPS\n# columns = id,x,y,z,label\na,1,2,3,A\nb,1,two,3,B\n");
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<markups before=\"bad.fcsv\" after=\"bad.fcsv\"/>");
  expect_refused(run_scene("bad.xml"), {"bad.fcsv", "4"});
  write_text(at("bad.xml"), "<scene>\n<image t1=\"t1.nii.gz\"\n</scene>");
  expect_refused(run_scene("bad.xml"), {"bad.xml:", "XML"});
}

TEST_F(BadInput, AMaterialThatCannotBe) {
  const std::pair<const char*, std::vector<std::string>> cases[] = {
      {"1:3000,0.5", {"poisson_ratio", "'0.5'", "< 0.5"}},
      {"1:0,0.49", {"youngs_modulus", "'0'", "> 0", "Pa"}},
      {"1:-3000,0.49", {"youngs_modulus", "'-3000'"}},
      {"1:3000,0.49,0", {"density", "'0'", "> 0", "kg/m3"}},
      {"1:brain,density=0", {"density", "'0'", "> 0"}},
      {"1:brane", {"material", "'brane'", "brain | brain_ogden"}},
      {"1:law=rubber", {"law", "'rubber'", "neo_hookean | ogden"}},
      {"1:law=ogden", {"label 1", "no terms"}},
      {"1:ogden=842,-4.7", {"842,-4.7", "neo_hookean", "set the law to ogden"}},
      {"1:law=ogden,ogden=842", {"ogden", "'842'", "pairs mu,alpha"}},
      {"1:law=ogden,ogden=842,0", {"alpha = 0"}},
      {"'1:law=ogden,ogden=842,-4.7;-900,2'", {"unstable at rest", "-58 Pa"}},
      {"1:brain,prony=1.2,1", {"1.2", "below 1"}},
      {"1:brain,prony=0.2,0", {"time 0 s", "positive"}},
      {"1:brain,stiffness=3", {"no attribute 'stiffness'", "youngs_modulus"}},
      {"1:brain,law=ogden,law=ogden", {"law twice"}},
      {"1:brain --material 1:brain", {"label 1 twice"}},
  };
  for (const auto& [material, parts] : cases) {
    expect_refused(solve_box(std::string("--material ") + material), parts);
  }
}

TEST_F(BadInput, ATissueThatCannotBe) {
  const std::pair<const char*, std::vector<std::string>> cases[] = {
      {"law=\"ogden\"", {"bad.xml:3", "no terms"}},
      {"ogden=\"842,-4.7\"", {"bad.xml:3", "842,-4.7", "law neo_hookean"}},
      {"law=\"ogden\" ogden=\"842,-4.7; -900,2\"", {"bad.xml:3", "unstable at rest"}},
      {"material=\"brian\"", {"bad.xml:3", "'brian'", "brain | brain_ogden"}},
      {"prony=\"0.5\"", {"bad.xml:3", "'0.5'", "pairs share,time"}},
  };
  for (const auto& [attributes, parts] : cases) {
    write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"load.csv\"/>",
                std::string("<tissue label=\"1\" ") + attributes + "/>");
    expect_refused(run_scene("bad.xml"), parts);
  }
}

TEST_F(BadInput, OptionsInTimeThatMakeNoSense) {
  const std::string brain = "--material 1:brain ";
  expect_refused(solve_box(brain + "--dynamics transient --time-step 0.1"), {"0.1 s", "critical"});
  expect_refused(solve_box(brain + "--damping 3"), {"damping", "relaxation", "transient"});
  expect_refused(solve_box(brain + "--time-step 1e-4"), {"time_step", "relaxation"});
  expect_refused(solve_box(brain + "--duration 1"), {"duration", "relaxation"});
  expect_refused(solve_box(brain + "--curve-join straight"), {"curve_join", "no curve"});
  expect_refused(solve_box(brain + "--gravity 1,2"), {"--gravity", "'1,2'", "three numbers", "m/s2"});
  write_text(at("curve.csv"), "time,factor\n0,0\n1,1\n");
  expect_refused(solve_box(brain + "--dynamics transient --duration 2 --curve " + at("curve.csv")),
                 {"duration", "curve", "one of them"});
  expect_refused(run_scene("scene.xml") + " --set solve.damping=3", {"--set", "damping", "relaxation"});
  expect_refused(run_scene("scene.xml") + " --set solve.curve=none.csv", {"--set", "none.csv", "does not exist"});
}

TEST_F(BadInput, ACurveThatIsNone) {
  const std::pair<const char*, std::vector<std::string>> cases[] = {
      {"t,f\n0,0\n1,1\n", {":1:", "time,factor"}},      {"time,factor\n0,0\n2,1\n1,1\n", {":4:", "not later"}},
      {"time,factor\n1,0\n2,1\n", {"start at time 0"}}, {"time,factor\n0,1\n2,1\n", {"factor 0"}},
      {"time,factor\n0,0\n1,one\n", {":3:", "one"}},
  };
  for (const auto& [text, parts] : cases) {
    write_text(at("curve.csv"), text);
    std::vector<std::string> said = parts;
    said.push_back("curve.csv");
    expect_refused(solve_box("--material 1:brain --curve " + at("curve.csv")), said);
    expect_refused(run_scene("scene.xml") + " --set solve.curve=curve.csv", said);
  }
}

TEST_F(BadInput, NodesThatSayTheSame) {
  expect_refused(solve_box("--material 1:brain",
                           [](NodeCloud& cloud) {
                             cloud.positions.row(5) = cloud.positions.row(4) + Eigen::RowVector3d(5e-5, 0, 0);
                           }),
                 {"nodes 4 and 5", "apart", "remove one of them"});
}

TEST_F(BadInput, PlanesOfTheWrongCells) {
  expect_refused(solve_box("--material 1:brain --plane stress"), {"quadrilaterals or triangles"});
  expect_refused(solve_box("--material 1:brain --plane bent"), {"--plane", "bent", "strain", "stress"});
  expect_refused(solve_flat("--material 1:brain"), {"planar", "plane strain or plane stress"});
  expect_refused(solve_flat("--material 1:brain_viscoelastic --plane stress"), {"label 1", "relaxes", "plane strain"});
  expect_refused(solve_flat("--material 1:brain --plane strain --points-per-cell 3"), {"3"});
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
  write_text(at("file"), "a file, not a folder");
  expect_refused("brainshift run --quiet " + at("scene.xml") + " --out " + at("file/run"), {at("file")}, 1);
  expect_refused("brainshift segment --quiet --brain-labels 1 --edge-length 12 --labels " + at("labels.nii.gz") +
                     " --out " + at("file/run"),
                 {at("file")}, 1);
  expect_refused("brainshift phantom --quiet --size 24 --spacing 8 --out " + at("file/head"), {at("file")}, 1);
}

TEST_F(BadInput, APhantomWhereAPatientLies) {
  const std::string phantom = "brainshift phantom --quiet --size 24 --spacing 8 --out " + at("patient");
  ASSERT_EQ(run_shell(phantom).code, 0);
  EXPECT_EQ(run_shell(phantom).code, 0) << "the same again";
  write_text(at("patient/t1.nii.gz"), "a patient's");
  expect_refused(phantom, {at("patient/t1.nii.gz"), "choose another folder"});
  EXPECT_EQ(bytes_of(at("patient/t1.nii.gz")), "a patient's");
}

TEST_F(BadInput, AFullDisk) {
  // A limit on the size of files stands for it: writes fail from there on. One block is 512 bytes.
  expect_refused("ulimit -f 8\n" + run_scene("scene.xml"), {"out/"}, 1);
  expect_refused("ulimit -f 1\nbrainshift phantom --quiet --size 24 --spacing 8 --out " + at("out"), {"out"}, 1);
  // With room again the same command runs through.
  EXPECT_EQ(run_shell(run_scene("scene.xml")).code, 0);
}

TEST_F(BadInput, CommandLinesThatMakeNoSense) {
  expect_refused("brainshift run", {"scene"});
  expect_refused("brainshift fly", {"no command 'fly'"});
  expect_refused("brainshift run --threads 0 " + at("scene.xml") + " --out " + at("out"), {"threads"});
  expect_refused("brainshift run --quiet " + at("scene.xml") + " --until lunch --out " + at("out"),
                 {"lunch", "discretise"});
  expect_refused("brainshift segment --edge-length -3 --labels a --out " + at("out"),
                 {"--edge-length", "-3", ">= 0.5"});
  expect_refused(solve_ball("--material 1:3000"), {"--material", "LABEL:E_Pa,nu"});
  expect_refused(solve_ball("--material 1:3000,0.7"), {"poisson_ratio", "0.7"});
}

}  // namespace brainshift::bad_input_test
