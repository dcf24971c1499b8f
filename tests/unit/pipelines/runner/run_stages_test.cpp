// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/run_stages.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/ball_folder.hpp"

namespace brainshift::pipelines::run_stages_test {

using brainshift::test::expect_parts;
using brainshift::test::refusal;
using Kind = RunEvent::Kind;

class RunTest : public BallFolder {
 protected:
  RunOutcome run_ball(const std::vector<std::string>& overrides = {}, StageId until = StageId::report,
                      bool force = false) {
    events_.clear();
    return run_stages(ball_scene(overrides), {.out = out_, .until = until, .force = force}, {}, interruption_,
                      [this](const RunEvent& event) { events_.push_back(event); });
  }
  /// "done kept outdated", stage by stage.
  std::string statuses() const {
    const auto record = nlohmann::ordered_json::parse(read(out_ / "run.json"));
    std::string all;
    for (const auto& [name, stage] : record["stages"].items()) {
      all += (all.empty() ? "" : " ") + stage["status"].get<std::string>();
    }
    return all;
  }
  /// The stages of which something was told, as often as it was.
  std::vector<StageId> told(Kind kind) const {
    std::vector<StageId> stages;
    for (const RunEvent& event : events_) {
      if (event.kind == kind) {
        stages.push_back(event.stage);
      }
    }
    return stages;
  }

  fs::path out_ = folder_ / "out";
  std::vector<RunEvent> events_;
};

const std::vector<StageId> first_three = {StageId::segment, StageId::discretise, StageId::solve};

TEST_F(RunTest, RunsItsStagesInOrderAndLeavesOutThoseThatNeedAnImage) {
  const RunOutcome outcome = run_ball();
  EXPECT_EQ(outcome.failure, "");
  EXPECT_EQ(statuses(), "done done done inactive inactive");
  EXPECT_EQ(outcome.record, nlohmann::ordered_json::parse(read(out_ / "run.json")));
  for (const char* file : {"segment/brain.vtp", "discretise/nodes.vtu", "solve/solution.vtu", "solve/stage.json"}) {
    EXPECT_TRUE(fs::exists(out_ / file)) << file;
  }
  EXPECT_FALSE(fs::exists(out_ / "register"));
  EXPECT_EQ(told(Kind::started), first_three);
  EXPECT_EQ(told(Kind::finished), first_three);
}

TEST_F(RunTest, TellsAProgressThatGrowsToOne) {
  run_ball();
  ASSERT_GT(events_.size(), 10U);
  EXPECT_TRUE(std::ranges::is_sorted(events_, {}, &RunEvent::total_fraction));
  EXPECT_NEAR(events_.back().total_fraction, 1, 1e-12);
  for (const RunEvent& event : events_) {
    EXPECT_TRUE(event.fraction >= 0 && event.fraction <= 1);
  }
}

TEST_F(RunTest, KeepsWhatHasNotChangedAndRunsFromTheChangeOn) {
  run_ball();
  const std::string solution = read(out_ / "solve/solution.vtu");
  run_ball();
  EXPECT_EQ(statuses(), "kept kept kept inactive inactive");
  EXPECT_EQ(told(Kind::kept), first_three);
  EXPECT_TRUE(told(Kind::started).empty());
  run_ball({"solve.basis=modified_quadratic"});
  EXPECT_EQ(statuses(), "kept kept done inactive inactive");
  EXPECT_NE(read(out_ / "solve/solution.vtu"), solution);
  run_ball({}, StageId::report, true);
  EXPECT_EQ(statuses(), "done done done inactive inactive");
  EXPECT_EQ(read(out_ / "solve/solution.vtu"), solution);
}

TEST_F(RunTest, RunsAStageAgainWhoseFileIsGone) {
  run_ball();
  fs::remove(out_ / "discretise/cells.vtu");
  run_ball();
  EXPECT_EQ(statuses(), "kept done kept inactive inactive") << "the same cells as before";
}

TEST_F(RunTest, RunsAStageAgainWhoseFileIsDamaged) {
  run_ball();
  const std::string skull = read(out_ / "segment/skull.vtp");
  const std::string load = read(out_ / "solve/load.csv");
  write("out/segment/skull.vtp", "");
  write("out/solve/load.csv", load.substr(0, load.size() / 2));
  run_ball();
  EXPECT_EQ(statuses(), "done kept done inactive inactive");
  EXPECT_EQ(read(out_ / "segment/skull.vtp"), skull);
  EXPECT_EQ(read(out_ / "solve/load.csv"), load);
}

TEST_F(RunTest, KeepsAnEditedSurfaceAndRunsTheStagesAfterIt) {
  run_ball();
  write_surface(out_ / "segment/brain.vtp", brainshift::test::sphere({0, 0, 0}, 20.5, 3));
  const std::string edited = read(out_ / "segment/brain.vtp");
  run_ball();
  EXPECT_EQ(statuses(), "kept done done inactive inactive");
  EXPECT_EQ(read(out_ / "segment/brain.vtp"), edited);
}

TEST_F(RunTest, FailsWhenAnInputChangesUnderItAndThenReadsItAgain) {
  const std::string load = read(folder_ / "load.csv");
  const Scene scene = ball_scene();
  const std::string fault = refusal([&] {
    run_stages(scene, {.out = out_}, {}, interruption_, [&](const RunEvent& event) {
      if (event.kind == Kind::started && event.stage == StageId::solve) {  // after its checksum was taken
        usleep(30'000);
        write("load.csv", load.substr(0, load.rfind('\n', load.size() - 2) + 1));
      }
      if (event.kind == Kind::progress && event.stage == StageId::solve && event.fraction > 0) {
        write("load.csv", load);
      }
    });
  });
  expect_parts(fault, {(folder_ / "load.csv").string(), "changed while it was read"});
  EXPECT_FALSE(fs::exists(out_ / "solve"));
  EXPECT_EQ(run_ball().failure, "");
  EXPECT_EQ(statuses(), "kept kept done inactive inactive");
}

TEST_F(RunTest, LeavesTheFoldersOfSomebodyElseBesideAStage) {
  run_ball();
  for (const char* name : {"out/solve.partial/mine", "out/solve.old/mine"}) {
    write(name, "mine");
    expect_parts(refusal([&] { run_ball({}, StageId::report, true); }), {"not made by brainshift"});
    EXPECT_EQ(read(folder_ / name), "mine");
    fs::remove_all((folder_ / name).parent_path());
  }
}

TEST_F(RunTest, UntilAStageTellsWhichLaterOnesNoLongerHold) {
  run_ball();
  run_ball({}, StageId::segment);
  EXPECT_EQ(statuses(), "kept done done");
  run_ball({"discretise.nodes=70"}, StageId::discretise);
  EXPECT_EQ(statuses(), "kept done outdated");
}

TEST_F(RunTest, ThatDoesNotConvergeKeepsWhatItHasAndIsTriedAgain) {
  for (int time = 0; time < 2; ++time) {
    const RunOutcome outcome = run_ball({"solve.max_steps=3"});
    expect_parts(outcome.failure, {"3 steps"});
    EXPECT_EQ(statuses(), time == 0 ? "done done failed" : "kept kept failed");
    EXPECT_EQ(outcome.record["stages"]["solve"]["failure"], outcome.failure);
    EXPECT_EQ(told(Kind::failed), std::vector<StageId>{StageId::solve});
    EXPECT_TRUE(fs::exists(out_ / "solve/solution.vtu"));
  }
}

TEST_F(RunTest, TellsAndRecordsItsWarnings) {
  write("load.csv", "# frame: LPS\nx,y,z,ux,uy,uz\n0,0,20,0,0,-1\n5,0,19.4,0,0,-1\n0,5,19.4,0,0,-1\n");
  const RunOutcome outcome = run_ball({"load.margin=8"});
  const std::vector<StageId> thrice(3, StageId::solve);
  EXPECT_EQ(told(Kind::note), thrice);
  ASSERT_EQ(outcome.record["stages"]["solve"]["notes"].size(), 3U);
  expect_parts(outcome.record["stages"]["solve"]["notes"][0], {"farther off than is estimated", "the moved patch"});
  expect_parts(outcome.record["stages"]["solve"]["notes"][1], {"measured at 3 places"});
  expect_parts(outcome.record["stages"]["solve"]["notes"][2], {"nothing but the load holds"});
  run_ball({"load.margin=8"});
  EXPECT_EQ(told(Kind::note), thrice) << "of the kept stage";
}

TEST_F(RunTest, DoesNotOverwriteAFolderOfSomebodyElse) {
  write("out/discretise/precious", "mine");
  expect_parts(refusal([&] { run_ball(); }), {(out_ / "discretise").string(), "not made by brainshift"});
  EXPECT_EQ(read(out_ / "discretise/precious"), "mine");
  EXPECT_TRUE(fs::exists(out_ / "segment/brain.vtp")) << "what was finished is kept";
}

TEST_F(RunTest, RefusesAFolderInWhichAnotherRunWorks) {
  fs::create_directories(out_);
  const int other = open(out_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(other, LOCK_EX | LOCK_NB), 0);
  try {
    run_ball();
    ADD_FAILURE();
  } catch (const std::runtime_error& fault) {
    expect_parts(fault.what(), {out_.string(), "another run is working in this folder"});
  }
  close(other);
  EXPECT_TRUE(fs::is_empty(out_));
  EXPECT_EQ(run_ball({}, StageId::segment).failure, "");
}

}  // namespace brainshift::pipelines::run_stages_test
