// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "pipelines/report/run_data.hpp"
#include "pipelines/runner/external_command.hpp"
#include "pipelines/runner/plan.hpp"
#include "pipelines/runner/run_record.hpp"
#include "pipelines/runner/sha256.hpp"
#include "pipelines/runner/stage_folder.hpp"

namespace brainshift::pipelines {
namespace {

namespace fs = std::filesystem;

class Runner : public testing::Test {
 protected:
  Runner() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("brainshift_runner_" + std::string(info->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Runner() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static std::string read(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  fs::path folder_;
  Interruption interruption_{[](int) {}};
};

TEST_F(Runner, Sha256GivesThePublishedDigests) {
  EXPECT_EQ(sha256_of_text(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of_text("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_text("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST_F(Runner, Sha256AgreesWithSha256sumAtEveryPadding) {
  for (const std::size_t size : {1U, 55U, 56U, 63U, 64U, 65U, 119U, 120U, 1000000U}) {
    const fs::path file = write("data", std::string(size, 'q'));
    FILE* pipe = popen(("sha256sum " + file.string()).c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::array<char, 65> digest{};
    ASSERT_NE(std::fgets(digest.data(), digest.size(), pipe), nullptr);
    pclose(pipe);
    EXPECT_EQ(sha256_of_file(file), digest.data()) << size << " bytes";
  }
}

/// The files of a run whose stages before solve are done, and its scene.
class Stamps : public Runner {
 protected:
  Stamps() {
    write("run/segment/brain.vtp", "brain");
    write("run/segment/skull.vtp", "skull");
    write("run/segment/labels.nii.gz", "labels");
    write("run/discretise/nodes.vtu", "nodes");
    write("run/discretise/cells.vtu", "cells");
    scene_.image.t1 = write("t1.nii", "t1");
    scene_.image.labels = write("labels.nii", "map");
    scene_.tissues.push_back({1, "parenchyma", "", {}});
    scene_.load.emplace().craniotomy = write("load.csv", "load");
    scene_.source.file = folder_ / "scene.xml";
  }
  std::string stamp_of(StageId stage) { return stamp(plan_stage(stage, scene_, folder_ / "run", interruption_)); }
  /// Which of the stages segment, discretise, solve, register change their stamps: as "sdvr", "-" where not.
  std::string changed_by(const std::function<void()>& change) {
    const std::array<StageId, 4> stages = {StageId::segment, StageId::discretise, StageId::solve,
                                           StageId::registration};
    std::array<std::string, 4> before;
    for (std::size_t i = 0; i < 4; ++i) {
      before[i] = stamp_of(stages[i]);
    }
    change();
    std::string changed;
    for (std::size_t i = 0; i < 4; ++i) {
      changed += stamp_of(stages[i]) == before[i] ? '-' : "sdvr"[i];
    }
    return changed;
  }

  Scene scene_;
};

TEST_F(Stamps, ChangeForTheStagesThatDependOnAnOptionAlone) {
  EXPECT_EQ(changed_by([] {}), "----");
  EXPECT_EQ(changed_by([&] { scene_.segment.edge_length = 4; }), "s---");
  EXPECT_EQ(changed_by([&] { scene_.discretise.seed = 2; }), "-d--");
  EXPECT_EQ(changed_by([&] { scene_.solve.tolerance = 0.1; }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.tissues[0].material.youngs_modulus = 1; }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.tissues[0].material.prony.push_back({0.5, 1}); }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.loading.gravity.z() = -9.81; }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.contact.emplace(); }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.cuts.emplace().files.push_back({write("cut.vtp", "cut"), {}}); }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.cuts->contact = true; }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.cuts->files[0].timing.start = 0.5; }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.resection = solve::Resection{{1}, 0}; }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.registration.fade = 3; }), "---r");
  EXPECT_EQ(changed_by([&] { scene_.tissues.push_back({3, "", "", {}}); }), "sdv-");
}

TEST_F(Stamps, ChangeWithTheContentsOfFilesNotTheirNames) {
  EXPECT_EQ(changed_by([&] { write("t1.nii", "another"); }), "s--r");
  EXPECT_EQ(changed_by([&] { write("load.csv", "another"); }), "--v-");
  EXPECT_EQ(changed_by([&] { write("run/segment/brain.vtp", "another"); }), "-d-r");
  EXPECT_EQ(changed_by([&] { write("run/discretise/nodes.vtu", "another"); }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.load->craniotomy = write("moved.csv", "another"); }), "----");
  EXPECT_EQ(changed_by([&] { scene_.loading.curve = write("curve.csv", "one"); }), "--v-");
  EXPECT_EQ(changed_by([&] { write("curve.csv", "two"); }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.cuts.emplace().files.push_back({write("cut.vtp", "one"), {}}); }), "--v-");
  EXPECT_EQ(changed_by([&] { write("cut.vtp", "two"); }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.cuts->files[0].file = write("moved.vtp", "two"); }), "----");
}

TEST_F(Stamps, ACommandCountsWithTheScriptThatItNames) {
  write("mesher.sh", "one");
  EXPECT_EQ(changed_by([&] { scene_.commands[1] = "sh mesher.sh {in} {out}"; }), "-d--");
  EXPECT_EQ(changed_by([&] { write("mesher.sh", "two"); }), "-d--");
}

TEST_F(Runner, AnUnfinishedStageLeavesNothingBehind) {
  { StageFolder unfinished(folder_ / "stage", interruption_); }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Runner, AFinishedStageTakesThePlaceOfTheOneBefore) {
  write("stage/old", "old");
  StageFolder finished(folder_ / "stage", interruption_);
  std::ofstream(finished.path() / "new") << "new";
  finished.replace();
  EXPECT_TRUE(fs::exists(folder_ / "stage/new"));
  EXPECT_FALSE(fs::exists(folder_ / "stage/old"));
}

TEST_F(Runner, ASingleStageKeepsOtherFilesOfItsFolder) {
  write("stage/mine", "mine");
  write("stage/made", "old");
  StageFolder finished(folder_ / "stage", interruption_);
  std::ofstream(finished.path() / "made") << "new";
  finished.merge();
  EXPECT_EQ(read(folder_ / "stage/mine"), "mine");
  EXPECT_EQ(read(folder_ / "stage/made"), "new");
}

TEST_F(Runner, AStageRecordReadsBackAndADamagedOneIsNone) {
  write_stage_record(folder_, {"stamp", "failure", {{"status", "failed"}}});
  const auto record = read_stage_record(folder_);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->stamp, "stamp");
  EXPECT_EQ(record->failure, "failure");
  EXPECT_EQ(record->entry["status"], "failed");
  write("stage.json", "{\"stamp\": ");
  EXPECT_FALSE(read_stage_record(folder_));
}

TEST_F(Runner, ACommandSeesItsFoldersWhateverTheirNames) {
  const fs::path out = folder_ / "it's out";
  fs::create_directories(out);
  run_external_command({"echo {in} > {out}/said", folder_ / "in here", out, folder_}, interruption_);
  EXPECT_EQ(read(out / "said"), (folder_ / "in here").string() + "\n");
}

TEST_F(Runner, AHistoryIsReadByTheNamesOfItsColumns) {
  const auto rows = read_history(write("h.csv", "time,step,mine,reaction_z_N,error_bound_mm\n0.5,20,7,-3,inf\n"));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].time, 0.5);
  EXPECT_EQ(rows[0].step, 20);
  EXPECT_EQ(rows[0].reaction, Eigen::Vector3d(0, 0, -3));
  EXPECT_TRUE(std::isinf(rows[0].error_bound));
  EXPECT_EQ(rows[0].dissipated_energy, 0) << "a column that is not there";
  const std::pair<const char*, const char*> faults[] = {{"step\n1\n", "no column 'time'"},
                                                        {"step,time\n1\n", "line 2: 2 numbers"},
                                                        {"step,time\n1,2\n3,x\n", "line 3: time is 'x'"}};
  for (const auto& [text, said] : faults) {
    try {
      read_history(write("h.csv", text));
      FAIL() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
  }
}

TEST_F(Runner, AFailedCommandIsAFaultWithItsCodeAndLastWords) {
  try {
    run_external_command({"echo first; echo no mesh >&2; exit 7", folder_, folder_, folder_}, interruption_);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("code 7"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("no mesh"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace brainshift::pipelines
