// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bad cuts, rupture and resection through the program: each ends with the right code and one sentence.
#include "segmentation/files/surface_file.hpp"
#include "segmentation/geometry/surface.hpp"
#include "tests/phantoms/bad_input.hpp"

namespace brainshift::bad_cut_test {

using BadCut = bad_input::BadInput;

Surface one_triangle() {
  Surface sheet{Points(3, 3), Triangles(1, 3)};
  sheet.vertices << 0, 0, 5, 9, 0, 5, 0, 9, 5;
  sheet.triangles << 0, 1, 2;
  return sheet;
}

TEST_F(BadCut, CutsThatAreNone) {
  const std::string flat = "--material 1:brain --plane strain ";
  const std::pair<const char*, std::vector<std::string>> paths[] = {
      {"", {"empty"}},
      {"a,b\n1,2\n", {":1:", "x,y"}},
      {"x,y\n1,2\n", {"1 vertex", "two"}},
      {"x,y\n0,9\n9,9\n9,9\n", {":4:", "repeats"}},
      {"x,y\n0,9\n9,nine\n", {":3:", "nine"}},
      {"x,y\n0,9\n9,9\n9,19\n5,0\n", {"lines 2 to 3", "lines 4 to 5", "crosses"}},
      {"x,y,time\n0,9,1\n9,9,0.5\n", {":3:", "before"}},
  };
  for (const auto& [text, parts] : paths) {
    write_text(at("cut.csv"), text);
    std::vector<std::string> said = parts;
    said.push_back("cut.csv");
    expect_refused(solve_flat(flat + "--cut " + at("cut.csv")), said);
  }
  expect_refused(solve_flat(flat + "--cut " + at("none.csv")), {"none.csv", "no such file"});
  expect_refused(solve_flat(flat + "--cut " + at("ball/brain.vtp")), {"brain.vtp", "closed"});
  write_surface(at("sheet.vtp"), one_triangle());
  expect_refused(solve_flat(flat + "--cut " + at("sheet.vtp")), {"sheet.vtp", "sheet", "paths (.csv, x,y)"});
  write_text(at("path.csv"), "x,y\n0,9\n9,9\n");
  expect_refused(solve_box("--material 1:brain --cut " + at("path.csv")), {"path.csv", "--plane", "sheets"});
  expect_refused(solve_ball("--cut " + at("ball/skull.vtp")), {"skull.vtp", "closed"});
}

TEST_F(BadCut, OptionsOfCutsThatMakeNoSense) {
  const std::string flat = "--material 1:brain --plane strain ", box = "--material 1:brain ";
  const std::string path = flat + "--cut-path '0,15; 20,15' ";
  expect_refused(solve_flat(flat + "--cut-path '0,15; 20'"), {"--cut-path", "'0,15; 20'", "x,y", "semicolons"});
  expect_refused(solve_flat(flat + "--cut-path '0,15'"), {"--cut-path '0,15'", "1 vertex"});
  expect_refused(solve_flat(flat + "--cut-path '0,0; 9,0; 9,9; 5,-3'"), {"--cut-path", "points 1 to 2", "points 3 to"});
  expect_refused(solve_box(box + "--cut-path '0,15; 20,15'"), {"--cut-path", "--plane", "sheet"});
  expect_refused(solve_flat(path + "--cut-start -1"), {"--cut-start", "'-1'", ">= 0"});
  expect_refused(solve_flat(path + "--cut-speed 0"), {"--cut-speed", "'0'", "> 0", "mm"});
  expect_refused(solve_flat(path + "--cut-speed 9 --cut-direction '1 0 0'"), {"--cut-path", "direction"});
  expect_refused(solve_flat(path + "--cut-contact often"), {"--cut-contact", "'often'", "no | yes"});
  write_text(at("timed.csv"), "x,y,time\n0,9,0\n9,9,1\n");
  expect_refused(solve_flat(flat + "--cut-speed 9 --cut " + at("timed.csv")), {"timed.csv", "times", "speed"});
  write_surface(at("sheet.vtp"), one_triangle());
  expect_refused(solve_box(box + "--cut-speed 9 --cut " + at("sheet.vtp")), {"sheet.vtp", "direction"});
  expect_refused(solve_box(box + "--region 1 --cut " + at("sheet.vtp")), {"region", "cuts"});
  expect_refused(solve_flat(path + "--region 1"), {"region"});
  for (const char* alone : {"--cut-start 1", "--cut-speed 1", "--cut-direction 1,0,0", "--cut-contact yes"}) {
    expect_refused(solve_flat(flat + alone), {"no cut", "--cut"});
  }
}

TEST_F(BadCut, RuptureThatMakesNoSense) {
  const std::string flat = "--material 1:brain --plane strain ";
  expect_refused(solve_box("--material 1:brain --rupture stretch=1.4"), {"--rupture", "--plane"});
  expect_refused(solve_flat(flat + "--rupture stretch=0.9"), {"--rupture", "stretch", "'0.9'", "> 1"});
  expect_refused(solve_flat(flat + "--rupture stress=-3"), {"--rupture", "stress", "'-3'", "> 0", "Pa"});
  expect_refused(solve_flat(flat + "--rupture stretch=1.4,scatter=1"), {"scatter", "'1'", "< 1"});
  expect_refused(solve_flat(flat + "--rupture distance=1"), {"--rupture", "stretch", "stress"});
  expect_refused(solve_flat(flat + "--rupture '' --weak-spot 1,2,3,0.5"), {"--rupture", "stretch", "stress"});
  expect_refused(solve_flat(flat + "--weak-spot 1,2,3,0.5"), {"--weak-spot", "--rupture"});
  expect_refused(solve_flat(flat + "--rupture stretch=1.4 --weak-spot 1,2,3,1.5"),
                 {"--weak-spot", "1,2,3,1.5", "radius"});
  expect_refused(solve_flat(flat + "--rupture stretch=1.4 --weak-spot -1,2,0,0.5"), {"--weak-spot", "-1,2,0,0.5"});
}

TEST_F(BadCut, ResectionsThatMakeNoSense) {
  expect_refused(solve_box("--material 1:brain --resection 2"), {"label 2", "tissues' labels are 1"});
  expect_refused(solve_box("--material 1:brain --resection 1"), {"every tissue"});
  expect_refused(solve_box("--material 1:brain --resection tumour"), {"--resection", "'tumour'", "whole numbers"});
  expect_refused(solve_box("--material 1:brain --resection-pressure 5"), {"--resection-pressure", "--resection"});
  expect_refused(solve_box("--material 1:brain --material 2:brain --resection 2 --region 1"), {"region", "resection"});
  expect_refused(run_scene("scene.xml") + " --set resection.labels=3", {"--set", "label 3", "tissues' labels are 1"});
}

TEST_F(BadCut, CutsOfASceneThatCannotBe) {
  const std::string scene = bytes_of(at("scene.xml"));
  const auto with = [&](const std::string& cuts) {
    std::string text = scene;
    text.insert(text.find("<contact/>"), cuts + "\n");
    write_text(at("bad.xml"), text);
    return run_scene("bad.xml");
  };
  write_text(at("path.csv"), "x,y\n0,9\n9,9\n");
  expect_refused(with("<cuts><cut file=\"none.vtp\"/></cuts>"), {"bad.xml:5", "none.vtp", "no such file"});
  expect_refused(with("<cuts><cut file=\"ball/brain.vtp\"/></cuts>"), {"bad.xml:5", "brain.vtp", "closed"});
  expect_refused(with("<cuts><cut file=\"path.csv\"/></cuts>"), {"bad.xml:5", "path.csv", "brainshift solve --plane"});
  expect_refused(with("<cuts><cut path=\"0,0; 9,9\"/></cuts>"), {"bad.xml:5", "path", "brainshift solve --plane"});
  expect_refused(with("<cuts/>"), {"bad.xml:5", "names no cut"});
}

}  // namespace brainshift::bad_cut_test
