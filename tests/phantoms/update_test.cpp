// SPDX-License-Identifier: GPL-3.0-or-later
//
// A finished run under a new load, through the program.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "solve/load/craniotomy_load.hpp"
#include "solve/output/solution_file.hpp"
#include "tests/phantoms/program.hpp"

namespace brainshift::update_test {

namespace fs = std::filesystem;

std::string quoted(const fs::path& path) {
  return "'" + path.string() + "'";
}

class Update : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch = std::make_unique<ScratchFolder>();
    const fs::path head = *scratch / "head";
    const ProgramResult made = run_shell("brainshift phantom --size 40 --spacing 4.8 --out " + quoted(head));
    ASSERT_EQ(made.code, 0) << made.err;
    const ProgramResult ran =
        run_shell("brainshift run " + quoted(head / "scene.xml") + " --until solve --out " + quoted(run()) + small);
    ASSERT_EQ(ran.code, 0) << ran.err;
    load = solve::read_craniotomy_csv(head / "craniotomy.csv");
    solve::CraniotomyLoad more = load;
    for (Eigen::Index p = 0; p < more.displacement.rows(); ++p) {  // by up to 1 mm
      const double share = load.displacement.row(p).norm() / load.displacement.rowwise().norm().maxCoeff();
      more.displacement.row(p) += share * Eigen::RowVector3d(0.4, 0.2, -0.89);
    }
    solve::write_craniotomy_csv(new_load(), more);
  }
  static void TearDownTestSuite() { scratch.reset(); }

  static fs::path run() { return *scratch / "run"; }
  static fs::path new_load() { return *scratch / "new.csv"; }
  static ProgramResult update(const fs::path& of, const std::string& arguments) {
    return run_shell("brainshift update " + quoted(of) + " " + arguments);
  }
  /// One sentence, the input's fault.
  static void expect_refused(const ProgramResult& result, const std::string& what) {
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
  }
  /// A copy of the run in which a text of a file was put in place of another.
  static fs::path copy_with(const std::string& name, const std::string& file, const std::string& from,
                            const std::string& to) {
    fs::path copy = *scratch / name;
    fs::copy(run(), copy, fs::copy_options::recursive);
    const std::string text = bytes_of(copy / file);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << file;
    write_text(copy / file, text.substr(0, at) + to + text.substr(at + from.size()));
    return copy;
  }

  static constexpr const char* small =
      " --set segment.edge_length=10 --set discretise.nodes=450 --set solve.precision=double --quiet";
  static std::unique_ptr<ScratchFolder> scratch;
  static solve::CraniotomyLoad load;
};
std::unique_ptr<ScratchFolder> Update::scratch;
solve::CraniotomyLoad Update::load;

TEST_F(Update, IsAsARunFromTheBeginningAndLeavesTheRunAlone) {
  const std::string before = bytes_of(run() / "solve/solution.vtu");
  const ProgramResult first = update(run(), "--load " + quoted(new_load()));
  ASSERT_EQ(first.code, 0) << first.err;
  const fs::path made = run() / "update/new/solve/solution.vtu";
  const std::string answer = bytes_of(made);
  const fs::path unended = *scratch / "unended.csv";
  const std::string text = bytes_of(new_load());
  write_text(unended, text.substr(0, text.size() - 1));
  const ProgramResult second = update(run(), "--load " + quoted(unended) + " --out " + quoted(*scratch / "again"));
  ASSERT_EQ(second.code, 0) << second.err;
  constexpr const char* warned = "unended.csv: the last line has no line end";
  EXPECT_EQ(first.err.find("no line end"), std::string::npos) << first.err;
  EXPECT_NE(second.err.find(warned), std::string::npos) << second.err;
  EXPECT_EQ(answer, bytes_of(*scratch / "again/solve/solution.vtu")) << "from the file that is kept";
  EXPECT_EQ(before, bytes_of(run() / "solve/solution.vtu"));
  EXPECT_TRUE(half_written(run()).empty());

  const ProgramResult whole =
      run_shell("brainshift run " + quoted(*scratch / "head/scene.xml") + " --until solve --out " +
                quoted(*scratch / "whole") + small + " --set load.craniotomy.file=" + quoted(new_load()));
  ASSERT_EQ(whole.code, 0) << whole.err;
  const Points updated = read_solution(made).displacement;
  const Points solved = read_solution(*scratch / "whole/solve/solution.vtu").displacement;
  const Points old = read_solution(run() / "solve/solution.vtu").displacement;
  EXPECT_LT((updated - solved).rowwise().norm().maxCoeff(), 0.02);
  EXPECT_GT((updated - old).rowwise().norm().maxCoeff(), 0.5) << "the load has changed something";
}

/// A head that turns and drifts slowly in the fluid that is left.
TEST_F(Update, OfAHeadInDrainedFluidIsAsNearToRestAsItSays) {
  const fs::path head = *scratch / "large", drained = *scratch / "drained";
  ASSERT_EQ(run_shell("brainshift phantom --size 64 --spacing 3 --out " + quoted(head)).code, 0);
  const std::string how =
      " --until solve --preset fast --set discretise.nodes=400 --set gravity.direction=0,1,0 --set gravity.drained=30 "
      "--quiet --out ";
  const std::string run_scene = "brainshift run " + quoted(head / "scene.xml") + how;
  ASSERT_EQ(run_shell(run_scene + quoted(drained)).code, 0);
  for (const double factor : {1.2, 0.6}) {
    solve::CraniotomyLoad other = solve::read_craniotomy_csv(head / "craniotomy.csv");
    other.displacement *= factor;
    solve::write_craniotomy_csv(*scratch / "other.csv", other);
    const ProgramResult updated = update(drained, "--load " + quoted(*scratch / "other.csv"));
    ASSERT_EQ(updated.code, 0) << updated.err;
    const fs::path answer = drained / "update/other/solve", close = *scratch / "close";
    const ProgramResult ran = run_shell(run_scene + quoted(close) + " --set solve.tolerance=0.001 --set " +
                                        "load.craniotomy.file=" + quoted(*scratch / "other.csv"));
    ASSERT_EQ(ran.code, 0) << ran.err;
    const double off =
        (read_solution(answer / "solution.vtu").displacement - read_solution(close / "solve/solution.vtu").displacement)
            .rowwise()
            .norm()
            .maxCoeff();
    EXPECT_LT(off, read_table(answer / "history.csv").back().at("error_bound_mm")) << factor;
  }
}

TEST_F(Update, TellsHowWellANoisyLoadKnowsTheLandmarks) {
  const fs::path noisy = *scratch / "noisy";
  const ProgramResult ran = run_shell("brainshift run " + quoted(*scratch / "head/scene.xml") +
                                      " --until solve --out " + quoted(noisy) + small + " --set load.noise=0.5");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const ProgramResult updated = update(noisy, "--load " + quoted(*scratch / "head/craniotomy.csv"));
  ASSERT_EQ(updated.code, 0) << updated.err;
  const auto of_run = read_table(noisy / "solve/uncertainty.csv");
  ASSERT_FALSE(of_run.empty());
  const auto change = [&](const std::string& name) {
    const auto rows = read_table(noisy / "update" / name / "solve/uncertainty.csv");
    double most = 0;
    for (std::size_t i = 0; i < of_run.size(); ++i) {
      for (const auto& [column, value] : of_run[i]) {
        most = std::max(most, std::abs(rows.at(i).at(column) - value));
      }
    }
    return most;
  };
  double largest = 0;
  for (const auto& row : of_run) {
    largest = std::max({largest, row.at("xx"), row.at("yy"), row.at("zz")});
  }
  EXPECT_LT(change("craniotomy"), 0.01 * largest) << "of the same load, whose answer is as near as the tolerance";

  ASSERT_EQ(update(noisy, "--load " + quoted(new_load())).code, 0);
  EXPECT_GT(change("new"), 0.01 * largest);
}

TEST_F(Update, TakesARunWhoseNoiseWasTakenOut) {
  const std::string text = bytes_of(*scratch / "head/scene.xml");
  const std::size_t at = text.find("<load>");
  ASSERT_NE(at, std::string::npos);
  write_text(*scratch / "head/noisy.xml", text.substr(0, at) + "<load noise=\"0.5\">" + text.substr(at + 6));
  const ProgramResult ran =
      run_shell("brainshift run " + quoted(*scratch / "head/noisy.xml") + " --until solve --out " +
                quoted(*scratch / "exact") + small + " --set load.noise=");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const ProgramResult updated = update(*scratch / "exact", "");
  EXPECT_EQ(updated.code, 0) << updated.err;
}

TEST_F(Update, DamagedKeptFileIsMadeAgain) {
  ASSERT_EQ(update(run(), "").code, 0);
  const fs::path kept = run() / "update/kept.bin";
  std::string bytes = bytes_of(kept);
  const std::string whole = bytes;
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write_text(kept, bytes);
  ASSERT_EQ(update(run(), "").code, 0);
  EXPECT_TRUE(bytes_of(kept) == whole) << "the same bytes";
}

TEST_F(Update, RefusesLoadsThatAreNone) {
  solve::CraniotomyLoad elsewhere = load;
  const Points nodes = read_solution(run() / "solve/solution.vtu").positions;
  const Eigen::RowVector3d centre = (nodes.colwise().maxCoeff() + nodes.colwise().minCoeff()) / 2;
  elsewhere.positions = (2 * centre).replicate(load.positions.rows(), 1) - load.positions;
  elsewhere.displacement = -load.displacement;
  solve::write_craniotomy_csv(*scratch / "elsewhere.csv", elsewhere);
  expect_refused(update(run(), "--load " + quoted(*scratch / "elsewhere.csv")), "elsewhere");

  const std::string text = bytes_of(new_load());
  write_text(*scratch / "half.csv", text.substr(0, text.size() - text.size() / 3) + ",");
  expect_refused(update(run(), "--load " + quoted(*scratch / "half.csv")), "half.csv");
  expect_refused(update(run(), "--load " + quoted(*scratch / "none.csv")), "none.csv");

  solve::CraniotomyLoad noisy = load;
  noisy.sigma = Points::Constant(load.positions.rows(), 3, 0.5);
  solve::write_craniotomy_csv(*scratch / "noisy.csv", noisy);
  expect_refused(update(run(), "--load " + quoted(*scratch / "noisy.csv")), "standard deviations");
  EXPECT_FALSE(fs::exists(run() / "update/half"));
}

TEST_F(Update, RefusesRunsThatAreNone) {
  const std::string with_load = "--load " + quoted(new_load());
  expect_refused(update(*scratch / "nowhere", with_load), "no run.json");
  expect_refused(update(copy_with("other", "run.json", "\"version\": \"", "\"version\": \"9."), with_load), "9.");
  const fs::path unfinished = copy_with("unfinished", "run.json", "{", "{");
  fs::remove_all(unfinished / "solve");
  expect_refused(update(unfinished, with_load), "not finished");
  expect_refused(update(copy_with("changed", "solve/stage.json", "\"stamp\": \"", "\"stamp\": \"0"), with_load),
                 "has changed");
  expect_refused(update(run(), with_load + " --out " + quoted(run())), "this is a run");
}

/// What the run has of it would be answered, and look right.
TEST_F(Update, RefusesARunWhoseSceneOrFilesHaveChanged) {
  const std::string with_load = "--load " + quoted(new_load());
  for (const char* name : {"scene.xml", "labels.nii.gz"}) {
    const fs::path file = *scratch / "head" / name, away = *scratch / "away";
    fs::rename(file, away);
    std::string text = bytes_of(away);
    const std::size_t young = text.find("youngs_modulus=\"3000\"");
    text = young == std::string::npos ? "other" : text.replace(young, 21, "youngs_modulus=\"60000\"");
    write_text(file, text);
    const ProgramResult updated = update(run(), with_load);
    fs::rename(away, file);
    expect_refused(updated, name + std::string(": "));
    expect_refused(updated, "has changed since the run was made");
  }
}

TEST_F(Update, TakesARunWhoseSceneWasNamedFromItsOwnPlace) {
  const std::string there = "cd " + quoted(scratch->path()) + " && ";
  const ProgramResult ran =
      run_shell(there + "brainshift run head/scene.xml --until solve --out from_here" + std::string(small));
  ASSERT_EQ(ran.code, 0) << ran.err;
  if (fs::exists(run() / "update")) {  // of the same files and scene: it has the same key
    fs::copy(run() / "update", *scratch / "from_here/update", fs::copy_options::recursive);
  }
  const ProgramResult updated = update(*scratch / "from_here", "");
  EXPECT_EQ(updated.code, 0) << updated.err;
}

TEST_F(Update, RefusesARunThatTookOtherOptionsThanItsScenes) {
  const fs::path took =
      copy_with("took", "solve/stage.json", "\"measures\": {", "\"measures\": {\"took\": \"linear shape functions\",");
  expect_refused(update(took, "--load " + quoted(new_load())), "it took linear shape functions");
}

TEST_F(Update, IsInDoublePrecisionWhereTheRunTookIt) {
  const fs::path single = *scratch / "single", record = single / "solve/stage.json";
  const ProgramResult ran = run_shell("brainshift run " + quoted(*scratch / "head/scene.xml") +
                                      " --until solve --out " + quoted(single) + " --set discretise.nodes=450 --quiet");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::string text = bytes_of(record), precision = "\"precision\": \"single\"";
  ASSERT_NE(text.find(precision), std::string::npos);
  write_text(record, std::string(text).replace(text.find(precision), 0, "\"took\": \"double precision\", "));
  const ProgramResult updated = update(single, "--load " + quoted(new_load()));
  ASSERT_EQ(updated.code, 0) << updated.err;
  EXPECT_NE(bytes_of(single / "update/new/solve/stage.json").find("\"precision\": \"double\""), std::string::npos);
}

TEST_F(Update, SaysThatWhatItPreparedCannotBeKept) {
  const fs::path copy = copy_with("full", "run.json", "{", "{");
  fs::remove_all(copy / "update");
  write_text(copy / "update", "a file where a folder is wanted");
  const ProgramResult result = update(copy, "");
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find((copy / "update").string()), std::string::npos) << result.err;
}

TEST_F(Update, WeighsNoiseAsARunFromTheBeginning) {
  const auto run_with = [](const std::string& how, const std::string& name) {
    const ProgramResult ran = run_shell("brainshift run " + quoted(*scratch / "head/scene.xml") +
                                        " --until solve --out " + quoted(*scratch / name) + small + how);
    EXPECT_EQ(ran.code, 0) << ran.err;
  };
  const std::string of_new = " --set load.craniotomy.file=" + quoted(new_load());
  run_with(" --set load.noise=0.5", "noisy");
  run_with(" --set load.noise=0.5" + of_new, "whole_noisy");
  const ProgramResult updated = update(*scratch / "noisy", "--load " + quoted(new_load()));
  ASSERT_EQ(updated.code, 0) << updated.err;
  const fs::path made = *scratch / "noisy/update/new/solve";
  const Points answer = read_solution(made / "solution.vtu").displacement;
  const Points solved = read_solution(*scratch / "whole_noisy/solve/solution.vtu").displacement;
  EXPECT_LT((answer - solved).rowwise().norm().maxCoeff(), 0.02);
  EXPECT_NE(bytes_of(made / "load.csv").find("sigma"), std::string::npos);
  EXPECT_NE(bytes_of(made / "stage.json").find("weight_mJ"), std::string::npos);

  solve::CraniotomyLoad wrong = solve::read_craniotomy_csv(new_load());
  wrong.displacement(wrong.displacement.rows() / 2, 0) += 30;
  solve::write_craniotomy_csv(*scratch / "wrong.csv", wrong);
  const ProgramResult told = update(*scratch / "noisy", "--load " + quoted(*scratch / "wrong.csv"));
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_NE(told.err.find("standard deviations from what the other points say"), std::string::npos) << told.err;

  const fs::path robust = copy_with("robust", "run.json", "\"robust\": \"no\"", "\"robust\": \"yes\"");
  const ProgramResult refused = update(robust, "--load " + quoted(new_load()));
  expect_refused(refused, "robust weights");
  EXPECT_EQ(refused.err.find("solve ..."), std::string::npos) << "as if it had begun: " << refused.err;
}

}  // namespace brainshift::update_test
