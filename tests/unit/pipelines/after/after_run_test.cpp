// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/after/after_run.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "pipelines/runner/run.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/ball_folder.hpp"

namespace brainshift::pipelines::after_run_test {

using brainshift::test::expect_parts;
using brainshift::test::refusal;

class AfterRun : public BallFolder {
 protected:
  void run_to_the_solution(const Scene& scene) {
    run(scene, {.out = folder_ / "out", .until = StageId::solve}, interruption_);
  }
  std::string explain(const Scene& scene, std::optional<double> within = {}) {
    return explain_after(scene, folder_ / "out", within, interruption_,
                         [this](const std::string& what) { told_.push_back(what); });
  }

  std::vector<std::string> told_;
};

TEST_F(AfterRun, SaysWhatEachPartChanges) {
  const Scene scene = ball_scene({"solve.gravity=0,0,-9.81"});
  run_to_the_solution(scene);
  const std::string before = read(folder_ / "out/solve/stage.json");
  const std::string text = explain(scene);
  expect_parts(text, {"s as it was", " nodes\n",
                      "gravity (left out): ", "exact imposition (simplified): ", "the tolerance of 0.1 mm"});
  EXPECT_EQ(text.find("contact"), std::string::npos) << "there is none";
  EXPECT_EQ(text.find("quadratic"), std::string::npos) << "they are linear";
  ASSERT_GE(told_.size(), 3U);
  EXPECT_EQ(told_[0], "as it was");
  EXPECT_EQ(told_[1], "gravity: left out");
  EXPECT_EQ(read(folder_ / "out/solve/stage.json"), before) << "nothing is written";
}

TEST_F(AfterRun, APartIsNeededWhereItChangesMoreThanIsAllowed) {
  const Scene scene = ball_scene({"solve.gravity=0,0,-9.81"});
  run_to_the_solution(scene);
  const auto line_of_gravity = [&](double within) {
    const std::string text = explain(scene, within);
    const std::size_t begin = text.find("  gravity");
    return text.substr(begin, text.find('\n', begin) - begin);
  };
  expect_parts(line_of_gravity(1e3),
               {": leaving it out changes", "less than the tolerance of 1000 mm", ": you can leave it out"});
  expect_parts(line_of_gravity(1e-9), {"needed: leaving it out changes", "not less than the tolerance of 1e-09 mm"});
}

TEST_F(AfterRun, RefusesWhatIsNoRunOfTheScene) {
  const Scene scene = ball_scene();
  expect_parts(refusal([&] { explain(scene); }),
               {(folder_ / "out").string(), "not the folder of a run with a solution"});
  run_to_the_solution(scene);
  expect_parts(refusal([&] { explain(ball_scene({"solve.tolerance=0.2"})); }),
               {(folder_ / "out").string(), "not that of this scene", "the same --set"});
  Scene external = scene;
  external.commands[index_of(StageId::solve)] = "a_solver {in} {out}";
  expect_parts(refusal([&] { explain(external); }), {"scene.xml", "another program"});
  EXPECT_TRUE(told_.empty()) << "nothing was solved";
}

TEST_F(AfterRun, RefusesARunThatFailed) {
  const Scene scene = ball_scene({"solve.max_steps=3"});
  run_to_the_solution(scene);
  expect_parts(refusal([&] { explain(scene); }), {"its solve stage failed", "3 steps"});
}

}  // namespace brainshift::pipelines::after_run_test
