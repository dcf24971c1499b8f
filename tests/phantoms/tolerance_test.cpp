// SPDX-License-Identifier: GPL-3.0-or-later
//
// Speed against accuracy through the program: the sweep of settings, presets, a run to a tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/phantoms/program.hpp"

namespace brainshift::tolerance_test {

namespace fs = std::filesystem;
using nlohmann::json;

class Tolerance : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch = std::make_unique<ScratchFolder>();
    const ProgramResult head =
        run_shell("brainshift phantom --size 40 --spacing 4.8 --out " + (*scratch / "head").string());
    ASSERT_EQ(head.code, 0) << head.err;
  }
  static void TearDownTestSuite() { scratch.reset(); }

  static std::string scene() { return (*scratch / "head/scene.xml").string(); }
  static ProgramResult sweep(const std::string& more) {
    return run_shell("brainshift tradeoff " + scene() + " --out " + (*scratch / "sweep").string() +
                     " --points-per-cell auto --basis linear --derivatives full --tolerance 0.1 " + more);
  }
  static std::vector<std::string> lines(const fs::path& file) {
    std::istringstream text(bytes_of(file));
    std::vector<std::string> all;
    for (std::string line; std::getline(text, line);) {
      all.push_back(line);
    }
    return all;
  }
  static json record(const fs::path& out) { return json::parse(bytes_of(out / "run.json")); }

  static std::unique_ptr<ScratchFolder> scratch;
};
std::unique_ptr<ScratchFolder> Tolerance::scratch;

TEST_F(Tolerance, SweepMeasuresEachChoiceOnceAndCallsFailuresFailures) {
  const std::string lists = "--nodes 30,300,600 --precision double,single --reference-nodes 1200";
  const ProgramResult first = sweep(lists);
  ASSERT_EQ(first.code, 0) << first.err;
  const fs::path out = *scratch / "sweep";
  const std::vector<std::string> csv = lines(out / "tradeoff.csv");
  ASSERT_EQ(csv.size(), 7) << "a header and a line for each choice";
  EXPECT_EQ(std::count(csv[0].begin(), csv[0].end(), ','), std::count(csv[3].begin(), csv[3].end(), ','));
  EXPECT_NE(csv[1].find("30,auto,0,linear,full,double,0.1,,"), std::string::npos) << csv[1];
  EXPECT_NE(csv[1].find('"'), std::string::npos) << "why 30 nodes are too few";
  EXPECT_NE(first.out.find("95 % of the brain"), std::string::npos) << first.out;
  EXPECT_GT(fs::file_size(out / "tradeoff_solve.svg"), 1000U);
  EXPECT_GT(fs::file_size(out / "tradeoff_run.svg"), 1000U);
  const json coarse = json::parse(bytes_of(out / "points/300-auto-0-linear-full-double-0.1.json"));
  const json fine = json::parse(bytes_of(out / "points/600-auto-0-linear-full-double-0.1.json"));
  EXPECT_GT(fine["percentile_95_mm"], 0.0);
  EXPECT_LT(fine["percentile_95_mm"], coarse["percentile_95_mm"]);
  EXPECT_GT(fine["whole_seconds"], fine["solve_seconds"]);

  const fs::path point = out / "points/300-auto-0-linear-full-double-0.1.json";
  const auto made = fs::last_write_time(point);
  fs::remove(out / "points/600-auto-0-linear-full-double-0.1.json");
  ASSERT_EQ(sweep(lists).code, 0);
  EXPECT_EQ(fs::last_write_time(point), made) << "what is there is not done again";
  EXPECT_TRUE(fs::exists(out / "points/600-auto-0-linear-full-double-0.1.json"));
  ASSERT_EQ(sweep("--nodes 300 --precision double --reference-nodes 600 --set tissues.1.youngs_modulus=2000").code, 0);
  EXPECT_NE(fs::last_write_time(point), made) << "of another scene";
  EXPECT_TRUE(half_written(out).empty());
}

TEST_F(Tolerance, SweepRefusesListsThatMeanNothing) {
  const ProgramResult unknown = sweep("--basis linear,cubic");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("basis"), std::string::npos) << unknown.err;
  const ProgramResult coarse = sweep("--nodes 300,600 --reference-nodes 700");
  EXPECT_EQ(coarse.code, 2);
  EXPECT_NE(coarse.err.find("at least twice as many"), std::string::npos) << coarse.err;
}

TEST_F(Tolerance, RunReachesItAndSaysWhatItEstimated) {
  const fs::path out = *scratch / "reached";
  const std::string command = "brainshift run " + scene() + " --tolerance 0.6 --out " + out.string();
  const ProgramResult first = run_shell(command);
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_NE(first.err.find("estimated error"), std::string::npos);
  const json run = record(out);
  ASSERT_GE(run["tolerance"]["levels"].size(), 2);
  const json& last = run["tolerance"]["levels"].back();
  EXPECT_LE(last["estimated_error_95_mm"], 0.6);
  EXPECT_GT(last["estimated_error_95_mm"], 0.0);
  EXPECT_EQ(run["stages"]["solve"]["measures"]["estimated_error_95_mm"], last["estimated_error_95_mm"]);
  EXPECT_EQ(run["stages"]["solve"]["sizes"]["nodes"], last["nodes"]);
  EXPECT_NE(bytes_of(out / "report/index.html").find("estimated error"), std::string::npos);

  const auto made = fs::last_write_time(out / "solve/solution.vtu");
  ASSERT_EQ(run_shell(command).code, 0);
  EXPECT_EQ(fs::last_write_time(out / "solve/solution.vtu"), made);
  EXPECT_EQ(record(out)["stages"]["register"]["status"], "kept");
}

TEST_F(Tolerance, RunSaysWhatItReachedWhereItCouldNot) {
  const fs::path out = *scratch / "missed";
  const ProgramResult result = run_shell("brainshift run " + scene() + " --tolerance 0.001 --max-nodes 2500 --out " +
                                         out.string() + " --set solve.max_steps=50000");
  EXPECT_EQ(result.code, 3);
  EXPECT_NE(result.err.find("was not reached"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("2500 are allowed"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::exists(out / "report/index.html")) << "what was reached is carried to the end";
  EXPECT_GT(record(out)["stages"]["solve"]["measures"]["estimated_error_95_mm"], 0) << "the solve's own, of one level";
  EXPECT_EQ(run_shell("brainshift run " + scene() + " --tolerance 0 --out " + out.string()).code, 2);
  const ProgramResult few =
      run_shell("brainshift run " + scene() + " --tolerance 1 --max-nodes 999 --out " + out.string());
  EXPECT_EQ(few.code, 2);
  EXPECT_NE(few.err.find("begins with 1000 nodes"), std::string::npos) << few.err;
  EXPECT_EQ(run_shell("brainshift run " + scene() + " --tolerance 1 --preset fast --out " + out.string()).code, 2);
}

TEST_F(Tolerance, PresetsTakeThePlaceOfTheScenesSettingsAndSetOverridesThem) {
  const fs::path out = *scratch / "preset";
  const std::string command = "brainshift run " + scene() + " --out " + out.string() + " --until solve --preset fast";
  ASSERT_EQ(run_shell(command + " --set discretise.nodes=400").code, 0);
  EXPECT_EQ(record(out)["options"]["discretise"]["nodes"], "400");
  EXPECT_EQ(record(out)["options"]["solve"]["precision"], "single");
  const ProgramResult unknown = run_shell(command + "er");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("fast | balanced | accurate"), std::string::npos) << unknown.err;
}

}  // namespace brainshift::tolerance_test
