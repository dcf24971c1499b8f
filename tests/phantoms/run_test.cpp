// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whole runs of a small synthetic head, through the program: what a run leaves, what is kept, interruption, external
// stages. One head and one finished run serve all; a test that changes something copies the run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>

#include "segmentation/image/image.hpp"
#include "solve/output/solution_file.hpp"
#include "tests/phantoms/program.hpp"

namespace brainshift::run_test {

namespace fs = std::filesystem;
using nlohmann::json;

class Run : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch = std::make_unique<ScratchFolder>();
    const ProgramResult head = run_shell("brainshift phantom --size 40 --spacing 4.8 --out " + head_folder());
    ASSERT_EQ(head.code, 0) << head.err;
    const ProgramResult first = run(finished());
    ASSERT_EQ(first.code, 0) << first.err;
  }
  static void TearDownTestSuite() { scratch.reset(); }

  static std::string head_folder() { return (*scratch / "head").string(); }
  static fs::path finished() { return *scratch / "finished"; }
  static constexpr const char* small =
      " --set segment.edge_length=12 --set discretise.nodes=700 --set solve.tolerance=0.1 ";

  static ProgramResult run(const fs::path& out, const std::string& more = "", const std::string& scene = "scene.xml") {
    return run_shell("brainshift run " + head_folder() + "/" + scene + small + more + " --out " + out.string());
  }
  static fs::path copy_of_finished(const std::string& name) {
    fs::copy(finished(), *scratch / name, fs::copy_options::recursive);
    return *scratch / name;
  }
  static json record(const fs::path& out) { return json::parse(bytes_of(out / "run.json")); }
  /// The status of each stage, in order: "done done kept ...".
  static std::string statuses(const fs::path& out) {
    const json stages = record(out)["stages"];
    std::string text;
    for (const char* stage : {"segment", "discretise", "solve", "register", "report"}) {
      text += (text.empty() ? "" : " ") + (stages.contains(stage) ? stages[stage]["status"].get<std::string>() : "-");
    }
    return text;
  }
  /// The head's scene with a stage added, under another name.
  static std::string scene_with(const std::string& name, const std::string& from, const std::string& to) {
    std::string text = bytes_of(head_folder() + "/scene.xml");
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    text.replace(at, text.find("/>", at) + 2 - at, to);
    write_text(head_folder() + "/" + name, text);
    return name;
  }

  static std::unique_ptr<ScratchFolder> scratch;
};
std::unique_ptr<ScratchFolder> Run::scratch;

TEST_F(Run, LeavesEveryArtefactOfTheDesign) {
  for (const char* file :
       {"segment/labels.nii.gz", "segment/brain.vtp", "segment/skull.vtp", "discretise/nodes.vtu",
        "discretise/cells.vtu", "solve/solution.vtu", "solve/history.csv", "register/warped.nii.gz",
        "register/warped_labels.nii.gz", "register/intraop_to_preop.nii.gz", "register/preop_to_intraop.nii.gz",
        "register/from-preop_to-intraop_mode-image_xfm.h5", "register/from-preop_to-intraop_mode-points_xfm.h5",
        "register/landmarks.csv", "register/jacobian.nii.gz", "report/index.html", "run.json"}) {
    EXPECT_GT(fs::exists(finished() / file) ? fs::file_size(finished() / file) : 0, 0U) << file;
  }
  EXPECT_TRUE(half_written(finished()).empty());
}

TEST_F(Run, RecordsWhatItDid) {
  const json run = record(finished());
  EXPECT_EQ(statuses(finished()), "done done done done done");
  EXPECT_GE(run["threads"], 1);
  EXPECT_EQ(run["options"]["discretise"]["nodes"], "700");
  for (const json& input : run["inputs"]) {
    const std::string file = input["path"];
    const ProgramResult sum = run_shell("sha256sum " + file);
    EXPECT_EQ(sum.out.substr(0, 64), input["sha256"]) << file;
  }
  EXPECT_EQ(run["inputs"].size(), 4U) << "t1, labels, load, landmarks";
  for (const auto& [name, stage] : run["stages"].items()) {
    EXPECT_GT(stage["seconds"], 0.0) << name;
    EXPECT_GT(stage["peak_memory_mb"], 1.0) << name;
  }
  EXPECT_NEAR(run["stages"]["discretise"]["sizes"]["nodes"].get<double>(), 700, 70);
  EXPECT_TRUE(run["stages"]["solve"]["measures"]["converged"]);
  EXPECT_GT(run["stages"]["solve"]["sizes"]["loaded_nodes"], 0);
}

TEST_F(Run, ExplainsWhatEachPartChanged) {
  const std::string command = "brainshift scene --explain " + head_folder() + "/scene.xml" + small;
  const ProgramResult before = run_shell(command);
  ASSERT_EQ(before.code, 0) << before.err;
  EXPECT_NE(before.out.find("% of time"), std::string::npos) << before.out;
  const fs::path in_double = copy_of_finished("in_double");
  const std::string set_double = "--set solve.precision=double ";
  ASSERT_EQ(run(in_double, set_double).code, 0);
  const ProgramResult after = run_shell(command + set_double + "--after " + in_double.string());
  ASSERT_EQ(after.code, 0) << after.err;
  EXPECT_NE(after.out.find("contact (left out): needed"), std::string::npos) << after.out;
  EXPECT_NE(after.out.find("you can take it"), std::string::npos) << "single precision:\n" << after.out;
  const ProgramResult other = run_shell(command + "--set tissues.1.youngs_modulus=2000 --after " + finished().string());
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("not that of this scene"), std::string::npos) << other.err;
  EXPECT_EQ(run_shell(command + "--after " + head_folder()).code, 2) << "a folder that is no run";
}

/// Of a stage, as explained.
double megabytes(const std::string& text, const std::string& stage) {
  const std::size_t line = text.find("\n  " + stage + ": "), about = text.find("about ", line);
  return about == std::string::npos ? 0 : std::stod(text.substr(about + 6));
}

TEST_F(Run, ExplainsNoLessMemoryThanEachStageHoldsAndAtMostHalfAbove) {
  const ProgramResult said = run_shell("brainshift scene --explain " + head_folder() + "/scene.xml" + small);
  const fs::path out = *scratch / "memory";
  for (const std::string stage : {"segment", "discretise", "solve", "register", "report"}) {
    // Each in a process of its own, as a cohort runs them: what an earlier stage left in the heap would count.
    ASSERT_EQ(run(out, "--until " + stage).code, 0);
    const double held = record(out)["stages"][stage]["peak_memory_mb"];
    EXPECT_GE(megabytes(said.out, stage), held) << stage;
    EXPECT_LE(megabytes(said.out, stage), 1.5 * held) << stage;
  }
}

TEST_F(Run, RunsNothingAgainThatHasNotChanged) {
  const fs::path out = copy_of_finished("unchanged");
  const std::string before = bytes_of(out / "solve/stage.json");
  ASSERT_EQ(run(out).code, 0);
  EXPECT_EQ(statuses(out), "kept kept kept kept kept");
  EXPECT_EQ(bytes_of(out / "solve/stage.json"), before);
  ASSERT_EQ(run(out, "--threads 1").code, 0);
  EXPECT_EQ(statuses(out), "kept kept kept kept kept") << "results do not depend on the threads";
}

TEST_F(Run, RunsFromTheChangedStageOn) {
  const fs::path out = copy_of_finished("changed");
  ASSERT_EQ(run(out, "--set tissues.1.youngs_modulus=2000").code, 0);
  EXPECT_EQ(statuses(out), "kept kept done done done");
  ASSERT_EQ(run(out, "--set tissues.1.youngs_modulus=2000 --set register.interpolation=bspline").code, 0);
  EXPECT_EQ(statuses(out), "kept kept kept done done");
}

TEST_F(Run, SolvesWithThePhysicsThatTheSceneNames) {
  const fs::path out = copy_of_finished("physics");
  ASSERT_EQ(run(out,
                "--set tissues.1.material=brain_viscoelastic --set solve.volumetric=pointwise "
                "--set solve.dynamics=transient --set solve.duration=0.2 --set solve.damping=100")
                .code,
            0);
  EXPECT_EQ(statuses(out), "kept kept done done done");
  EXPECT_FALSE(record(out)["stages"]["solve"]["measures"].contains("error_bound_mm"));
  EXPECT_EQ(record(out)["options"]["tissues"]["1"]["ogden"], "842,-4.7");
  EXPECT_NE(bytes_of(out / "report/index.html").find("<h2>Energies</h2>"), std::string::npos);
}

TEST_F(Run, UntilStopsAndTellsWhatIsOutdated) {
  const fs::path out = copy_of_finished("until");
  ASSERT_EQ(run(out, "--until discretise").code, 0);
  EXPECT_EQ(statuses(out), "kept kept done done done");
  ASSERT_EQ(run(out, "--until discretise --set discretise.seed=2").code, 0);
  EXPECT_EQ(statuses(out), "kept done outdated outdated outdated");
  const fs::path fresh = *scratch / "fresh";
  ASSERT_EQ(run(fresh, "--until segment").code, 0);
  EXPECT_EQ(statuses(fresh), "done - - - -");
  EXPECT_FALSE(fs::exists(fresh / "discretise"));
}

TEST_F(Run, ForceRunsEverythingAndGivesTheSameFiles) {
  const fs::path out = copy_of_finished("force");
  ASSERT_EQ(run(out, "--force --until solve").code, 0);
  EXPECT_EQ(statuses(out).substr(0, 14), "done done done");
  for (const char* file : {"segment/brain.vtp", "discretise/nodes.vtu", "discretise/cells.vtu", "solve/solution.vtu"}) {
    EXPECT_EQ(bytes_of(out / file), bytes_of(finished() / file)) << file;
  }
}

TEST_F(Run, AStageWhoseArtefactIsMissingRunsAgain) {
  const fs::path out = copy_of_finished("missing");
  fs::remove(out / "discretise/cells.vtu");
  ASSERT_EQ(run(out).code, 0);
  EXPECT_EQ(statuses(out).substr(0, 14), "kept done kept");
}

TEST_F(Run, AnInterruptedRunLeavesNothingHalfWrittenAndContinues) {
  for (const auto& [signal, code] : {std::pair("INT", 130), std::pair("TERM", 143)}) {
    const fs::path out = *scratch / (std::string("interrupted") + signal);
    // The solve stage is made long; it is stopped when its folder appears. (A script's background jobs ignore SIGINT
    // unless told otherwise.)
    const std::string command = "env --default-signal=INT '" BRAINSHIFT_PROGRAM "' run " + head_folder() +
                                "/scene.xml --set solve.tolerance=1e-9" + " --set discretise.nodes=3000 --out " +
                                out.string() + " &\npid=$!\nn=0\n" + "while [ ! -e " + out.string() +
                                "/solve.partial ] && [ $n -lt 600 ]; do sleep 0.1; " +
                                "n=$((n+1)); done\nsleep 0.2\nkill -" + signal + " $pid\nwait $pid\nexit $?";
    const ProgramResult stopped = run_shell(command);
    EXPECT_EQ(stopped.code, code) << stopped.err;
    EXPECT_NE(stopped.err.find("interrupted"), std::string::npos) << stopped.err;
    EXPECT_TRUE(half_written(out).empty());
    EXPECT_FALSE(fs::exists(out / "solve"));
    const ProgramResult again = run_shell("brainshift run " + head_folder() + "/scene.xml --set discretise.nodes=3000" +
                                          " --until discretise --out " + out.string());
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(statuses(out), "kept kept - - -");
  }
}

TEST_F(Run, AKilledRunIsContinuedToo) {
  const fs::path out = copy_of_finished("killed");
  fs::remove_all(out / "solve");
  fs::create_directories(out / "solve.partial");
  write_text(out / "solve.partial/.unfinished", "");
  write_text(out / "solve.partial/solution.vtu", "half");
  ASSERT_EQ(run(out).code, 0);
  EXPECT_EQ(statuses(out).substr(0, 14), "kept kept done");
  EXPECT_TRUE(half_written(out).empty());
}

TEST_F(Run, AStageMayBeAnExternalCommand) {
  write_text(head_folder() + "/mesher.sh",
             "set -e\n\"$PROGRAM\" discretise --surface \"$1/segment/brain.vtp\" --labels \"$1/segment/labels.nii.gz\" "
             "--craniotomy craniotomy.csv --nodes 700 --out \"$2/raw\" --quiet\nmv \"$2\"/raw/*.vtu \"$2\"\nrm -r "
             "\"$2/raw\"\n");
  const std::string scene = scene_with("external.xml", "<stage name=\"discretise\"",
                                       "<stage name=\"discretise\" command=\"sh mesher.sh {in} {out}\"/>");
  const fs::path out = *scratch / "external";
  const std::string more = " --until solve";
  setenv("PROGRAM", BRAINSHIFT_PROGRAM, 1);
  const ProgramResult external = run(out, more, scene);
  ASSERT_EQ(external.code, 0) << external.err;
  EXPECT_EQ(bytes_of(out / "discretise/nodes.vtu"), bytes_of(finished() / "discretise/nodes.vtu"));
  EXPECT_EQ(bytes_of(out / "solve/solution.vtu"), bytes_of(finished() / "solve/solution.vtu"));
  ASSERT_EQ(run(out, more, scene).code, 0);
  EXPECT_EQ(statuses(out), "kept kept kept - -");
}

TEST_F(Run, AnExternalCommandThatFailsIsToldAndLeavesNothing) {
  const std::pair<const char*, const char*> cases[] = {
      {"echo no licence &gt;&amp;2; exit 9", "code 9, saying: no licence"},
      {"true", "wrote no nodes.vtu"},
      {"echo x &gt; {out}/nodes.vtu; echo x &gt; {out}/cells.vtu", "nodes.vtu"}};
  for (const auto& [command, said] : cases) {
    const std::string scene = scene_with("failing.xml", "<stage name=\"discretise\"",
                                         std::string("<stage name=\"discretise\" command=\"") + command + "\"/>");
    const fs::path out = *scratch / "failing";
    const ProgramResult result = run(out, "--quiet", scene);
    EXPECT_EQ(result.code, 2);
    EXPECT_NE(result.err.find(said), std::string::npos) << result.err;
    EXPECT_TRUE(half_written(out).empty());
    EXPECT_FALSE(fs::exists(out / "discretise"));
    EXPECT_TRUE(fs::exists(out / "segment/brain.vtp"));
  }
}

TEST_F(Run, ASolveThatDoesNotConvergeKeepsWhatItHas) {
  const fs::path out = *scratch / "diverged";
  const ProgramResult result = run(out, "--quiet --set solve.max_steps=5");
  EXPECT_EQ(result.code, 3);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_TRUE(fs::exists(out / "solve/solution.vtu"));
  EXPECT_EQ(statuses(out), "done done failed - -");
  ASSERT_EQ(run(out).code, 0);
  EXPECT_EQ(statuses(out), "kept kept done done done");
}

TEST_F(Run, StagesAloneGiveWhatTheRunGave) {
  const std::string out = (*scratch / "alone").string();
  const std::string r = finished().string();
  const ProgramResult result = run_shell(
      "set -e\nbrainshift segment --labels " + head_folder() + "/labels.nii.gz --edge-length " +
      record(finished())["options"]["segment"]["edge_length"].get<std::string>() + " --out " + out + "/segment\n" +
      "brainshift discretise --surface " + out + "/segment/brain.vtp --labels " + out +
      "/segment/labels.nii.gz --craniotomy " + head_folder() + "/craniotomy.csv --nodes 700 --out " + out +
      "/discretise\n" + "brainshift solve --nodes " + out + "/discretise/nodes.vtu --cells " + out +
      "/discretise/cells.vtu --labels " + out + "/segment/labels.nii.gz --surface " + out +
      "/segment/brain.vtp --skull " + r + "/segment/skull.vtp --load " + head_folder() +
      "/craniotomy.csv --material 1:3000,0.49 --material 2:10,0.1 --material 3:9000,0.49,1000 --tolerance 0.1 --out " +
      out + "/solve\n" + "brainshift register --solution " + out + "/solve/solution.vtu --brain " + out +
      "/segment/brain.vtp --t1 " + head_folder() + "/t1.nii.gz --labels " + out +
      "/segment/labels.nii.gz --landmarks " + head_folder() + "/landmarks.mrk.json --warp " + r +
      "/segment/brain.vtp --out " + out + "/register");
  ASSERT_EQ(result.code, 0) << result.err;
  for (const char* file : {"/segment/brain.vtp", "/discretise/cells.vtu", "/solve/solution.vtu",
                           "/register/landmarks.csv", "/register/warped.nii.gz", "/register/warped_labels.nii.gz"}) {
    EXPECT_EQ(bytes_of(out + file), bytes_of(r + file)) << file;
  }
  EXPECT_TRUE(fs::exists(out + "/register/warped_brain.vtp"));
  const ProgramResult twice = run_shell("brainshift report " + r + " --out " + r + "/segment");
  EXPECT_EQ(twice.code, 2);
  EXPECT_NE(twice.err.find("the folder of the stage segment"), std::string::npos) << twice.err;
}

TEST_F(Run, AStageAloneDoesNotWriteOverItsUsersFiles) {
  const std::string mine = (*scratch / "mine").string(), labels = "/labels.nii.gz";
  fs::create_directory(mine);
  LabelMap map = read_label_map(head_folder() + labels);
  for (std::uint16_t& label : map.voxels) {
    label = label == 6 ? std::uint16_t{0} : label;
  }
  write_image(mine + labels, map);
  const std::string before = bytes_of(mine + labels);
  const ProgramResult result = run_shell("brainshift segment --labels " + mine + labels +
                                         " --brain-labels 1 2 3 --skull-label 5 --edge-length 15 --out " + mine);
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("another file of that name"), std::string::npos) << result.err;
  EXPECT_EQ(bytes_of(mine + labels), before);
}

TEST_F(Run, ALoadOfMarkupsIsThatOfTheirDisplacements) {
  const std::string out = (*scratch / "markups").string(), r = finished().string();
  const std::string markups = "printf '# CoordinateSystem = LPS\n# columns = id,x,y,z,label\n'; awk -F, 'NR > 2 ";
  const ProgramResult result = run_shell(
      "set -e\nmkdir " + out + "\ncd " + head_folder() + "\n(" + markups +
      "{ printf \"%d,%s,%s,%s,p%d\\n\", NR, $1, $2, $3, NR }' craniotomy.csv) > before.fcsv\n(" + markups +
      "{ printf \"%d,%.17g,%.17g,%.17g,p%d\\n\", NR, $1 + $4, $2 + $5, $3 + $6, NR }' craniotomy.csv) > after.fcsv\n" +
      "for load in '--markups before.fcsv after.fcsv' '--load craniotomy.csv'; do\n  brainshift solve $load --nodes " +
      r + "/discretise/nodes.vtu --cells " + r + "/discretise/cells.vtu --labels labels.nii.gz --surface " + r +
      "/segment/brain.vtp --skull " + r + "/segment/skull.vtp --material 1:3000,0.49 --material 2:10,0.1 --material " +
      "3:9000,0.49,1000 --tolerance 0.1 --out " + out + "/$(echo $load | cut -c3-6)\ndone");
  ASSERT_EQ(result.code, 0) << result.err;
  const Solution of_markups = read_solution(out + "/mark/solution.vtu"),
                 of_csv = read_solution(out + "/load/solution.vtu");
  EXPECT_GT(of_csv.displacement.rowwise().norm().maxCoeff(), 5);
  EXPECT_LT((of_markups.displacement - of_csv.displacement).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(Run, WarpedFilesGoIntoAFolder) {
  write_text(*scratch / "afile", "");
  const ProgramResult result = run_shell("brainshift warp " + finished().string() + " " + head_folder() +
                                         "/landmarks.mrk.json --out " + (*scratch / "afile").string());
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("afile: this is a file"), std::string::npos) << result.err;
  const ProgramResult into_stage = run_shell("brainshift warp " + finished().string() + " " + head_folder() +
                                             "/labels.nii.gz --out " + (finished() / "register").string());
  EXPECT_EQ(into_stage.code, 2);
  EXPECT_NE(into_stage.err.find("is a stage's folder"), std::string::npos) << into_stage.err;
}

TEST_F(Run, OneOfTheTwoFieldsIsNotReplacedAlone) {
  const fs::path out = copy_of_finished("replaced");
  const std::string warp =
      "brainshift warp " + out.string() + " " + head_folder() + "/landmarks.mrk.json --out " + out.string() + "/moved";
  fs::copy(out / "register/intraop_to_preop.nii.gz", out / "register/preop_to_intraop.nii.gz",
           fs::copy_options::overwrite_existing);
  const ProgramResult result = run_shell(warp);
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("preop_to_intraop.nii.gz: it is another than the run made"), std::string::npos)
      << result.err;
}

TEST_F(Run, AReplacedSolutionIsSaidToBeOne) {
  const fs::path out = copy_of_finished("resolved");
  Solution other = read_solution(out / "solve/solution.vtu");
  other.displacement *= 0.5;
  write_solution(out / "solve/solution.vtu", other);
  ASSERT_EQ(run(out, "--quiet").code, 0);
  EXPECT_EQ(statuses(out), "kept kept kept done done");
  EXPECT_NE(record(out)["stages"]["solve"]["notes"].dump().find("not as this stage made it: solution.vtu"),
            std::string::npos);
  EXPECT_NE(bytes_of(out / "report/index.html").find("not as this stage made it"), std::string::npos);
}

TEST_F(Run, AFolderThatIsNotOursIsNotOverwritten) {
  const fs::path out = *scratch / "foreign";
  fs::create_directories(out / "segment");
  write_text(out / "segment/precious", "mine");
  const ProgramResult result = run(out, "--quiet");
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("not made by brainshift"), std::string::npos) << result.err;
  EXPECT_EQ(bytes_of(out / "segment/precious"), "mine");
}

TEST_F(Run, ReportCanBeMadeAgain) {
  const fs::path out = copy_of_finished("report");
  const ProgramResult result = run_shell("brainshift report " + out.string() + " --out " + out.string() + "/page");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(fs::exists(out / "page/index.html"));
}

}  // namespace brainshift::run_test
