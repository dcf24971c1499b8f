// SPDX-License-Identifier: GPL-3.0-or-later
//
// An operation in order: a ball is opened, drained, and its tumour taken out.
#include <nlohmann/json.hpp>

#include "solve/output/solution_file.hpp"
#include "tests/phantoms/bad_input.hpp"

namespace brainshift::sequence_test {

namespace fs = std::filesystem;

class Sequence : public bad_input::BadInput {
 protected:
  /// The ball's scene with a tumour of 16 mm beside its centre, and with more in it.
  static void write_operation(const std::string& name, const std::string& more) {
    LabelMap labels = bad_input::ball_labels();
    for (int k = 12; k < 16; ++k) {
      for (int j = 12; j < 16; ++j) {
        for (int i = 14; i < 18; ++i) {
          labels.at(i, j, k) = 3;
        }
      }
    }
    write_image(at("tumour.nii.gz"), labels);
    write_scene(name, "t1.nii.gz", "tumour.nii.gz", "<craniotomy file=\"load.csv\"/>",
                "<tissue label=\"1\"/><tissue label=\"3\"/>");
    std::string text = bytes_of(at(name));
    text.insert(text.find("</scene>"), "<stage name=\"register\" cavity_label=\"24\"/>" + more);
    write_text(at(name), text);
  }
  static std::string of(const std::string& state, const std::string& file) {
    return at("out/states/" + state + "/" + file);
  }
  static std::vector<std::uint16_t> image(const std::string& state) {
    return read_label_map(of(state, "register/warped_labels.nii.gz")).voxels;
  }
  static Points displacement(const fs::path& run) { return read_solution(run / "solve/solution.vtu").displacement; }

  static constexpr const char* drained = "<gravity direction=\"0 0 -1\" drained=\"40\"/>";
  static constexpr const char* resected = "<resection labels=\"3\"/>";
  static constexpr const char* options = " --set solve.points_per_cell=8 --set solve.tolerance=0.01";
};

TEST_F(Sequence, HasAnImageOfEachStateAndEndsWhereARunOfTheLastEnds) {
  write_operation("operation.xml", std::string("<sequence><state name=\"opened\"/><state name=\"drained\">") + drained +
                                       "</state><state name=\"resected\">" + resected + "</state></sequence>");
  const ProgramResult ran = run_shell(run_scene("operation.xml") + " --until register" + options);
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto states = nlohmann::json::parse(bytes_of(at("out/run.json")))["states"];
  EXPECT_EQ(states["drained"]["discretise"]["status"], "kept");
  EXPECT_GT(states["drained"]["solve"]["measures"]["moved_since_last_mm"], 0.1);
  EXPECT_NE(bytes_of(of("opened", "register/warped.nii.gz")), bytes_of(of("drained", "register/warped.nii.gz")));
  EXPECT_EQ(std::ranges::count(image("drained"), 24), 0);
  EXPECT_GT(std::ranges::count(image("resected"), 24), 0);
  EXPECT_EQ(std::ranges::count(image("resected"), 3), 0);

  write_operation("end.xml", std::string(drained) + resected);
  fs::copy(of("resected", ""), at("end"), fs::copy_options::recursive);
  fs::remove_all(at("end/solve"));
  const ProgramResult end =
      run_shell("brainshift run --quiet " + at("end.xml") + " --until solve --out " + at("end") + options);
  ASSERT_EQ(end.code, 0) << end.err;
  const auto at_once = nlohmann::json::parse(bytes_of(at("end/run.json")))["stages"];
  EXPECT_EQ(at_once["discretise"]["status"], "kept") << "the state's own body";
  EXPECT_LT(states["resected"]["solve"]["sizes"]["steps"], at_once["solve"]["sizes"]["steps"]);
  const Points last = displacement(of("resected", "")), whole = displacement(at("end"));
  ASSERT_EQ(last.rows(), whole.rows());
  EXPECT_LT((last - whole).rowwise().norm().maxCoeff(), 0.02) << "twice the tolerance";
  EXPECT_TRUE(half_written(at("out")).empty());

  fs::copy(at("out/states/drained"), at("out/states/gone"), fs::copy_options::recursive);
  const ProgramResult gone =
      run_shell("brainshift warp " + at("out/states/gone") + " " + at("t1.nii.gz") + " --out " + at("warped"));
  EXPECT_EQ(gone.code, 2);
  EXPECT_NE(gone.err.find("has it no more"), std::string::npos) << gone.err;
  fs::remove_all(at("out/states/gone"));

  const ProgramResult failed =
      run_shell(run_scene("operation.xml") + " --until register" + options + " --set solve.max_steps=20");
  EXPECT_EQ(failed.code, 3) << failed.err;
  for (const std::string state : {"drained", "resected"}) {
    const auto stages = nlohmann::json::parse(bytes_of(of(state, "run.json")))["stages"];
    EXPECT_EQ(stages["register"]["status"], "outdated") << state << ": it went on from what has failed now";
    const ProgramResult warped =
        run_shell("brainshift warp " + at("out/states/" + state) + " " + at("t1.nii.gz") + " --out " + at("warped"));
    EXPECT_EQ(warped.code, 2) << state;
    EXPECT_NE(warped.err.find("run it again"), std::string::npos) << warped.err;
  }
}

TEST_F(Sequence, WhatDoesNotGoWithOneIsSaid) {
  write_operation("operation.xml", std::string("<sequence><state name=\"drained\">") + drained + "</state></sequence>");
  expect_refused(run_scene("operation.xml") + " --tolerance 1", {"operation.xml:", "--tolerance refines one state"});
  expect_refused("brainshift tradeoff --quiet " + at("operation.xml") + " --out " + at("out"),
                 {"settings are varied of one state"});
}

}  // namespace brainshift::sequence_test
