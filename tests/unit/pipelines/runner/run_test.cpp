// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/run.hpp"

#include <gtest/gtest.h>

#include "pipelines/runner/update_run.hpp"
#include "solve/output/solution_file.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/ball_folder.hpp"

namespace brainshift::pipelines::run_test {

using brainshift::test::expect_parts;
using brainshift::test::refusal;

class RunSequence : public BallFolder {
 protected:
  void SetUp() override {
    BallFolder::SetUp();
    solve::CraniotomyLoad more = solve::read_craniotomy_csv(folder_ / "load.csv");
    more.displacement *= 1.5;
    solve::write_craniotomy_csv(folder_ / "more.csv", more);
  }
  /// Pressed, pressed by half more, and swollen.
  RunOutcome run_states(const std::vector<std::string>& overrides = {}, bool force = false) {
    const Scene scene = ball_scene(overrides, R"(<sequence><state name="first"/>
      <state name="second"><load><craniotomy file="more.csv"/></load></state>
      <state name="third"><tissues><tissue label="1" swelling="0.02"/></tissues></state></sequence>)");
    return run(scene, {.out = out_, .until = StageId::solve, .force = force}, interruption_,
               [this](const RunEvent& event) {
                 fractions_.push_back(event.total_fraction);
                 told_.push_back(std::string(event.state));
               });
  }
  std::string statuses(const std::string& state) const {
    const auto record = nlohmann::ordered_json::parse(read(out_ / "run.json"));
    std::string all;
    for (const auto& [name, stage] : record["states"][state].items()) {
      all += (all.empty() ? "" : " ") + stage["status"].get<std::string>();
    }
    return all;
  }
  nlohmann::ordered_json measures(const std::string& state) const {
    return nlohmann::ordered_json::parse(read(out_ / "run.json"))["states"][state]["solve"]["measures"];
  }
  fs::path state(const std::string& name) const { return state_folder(out_, name); }

  fs::path out_ = folder_ / "out";
  std::vector<double> fractions_;
  std::vector<std::string> told_;
};

TEST_F(RunSequence, EachStateGoesOnFromTheOneBeforeAndSharesItsBody) {
  const RunOutcome outcome = run_states();
  EXPECT_EQ(outcome.failure, "");
  EXPECT_EQ(outcome.record, nlohmann::ordered_json::parse(read(out_ / "run.json")));
  EXPECT_EQ(statuses("first"), "done done done");
  EXPECT_EQ(statuses("third"), "kept kept done");
  EXPECT_EQ(fs::read_symlink(state("third") / "discretise"), "../first/discretise");
  EXPECT_FALSE(measures("first").contains("moved_since_last_mm"));
  const auto displacement = [&](const std::string& name) {
    return read_solution(state(name) / "solve/solution.vtu").displacement;
  };
  const double moved = (displacement("second") - displacement("first")).rowwise().norm().maxCoeff();
  EXPECT_GE(moved, 0.5 - 1e-6) << "the load's change";
  EXPECT_NEAR(measures("second")["moved_since_last_mm"], moved, 1e-6);
  EXPECT_TRUE(std::ranges::is_sorted(fractions_));
  EXPECT_NEAR(fractions_.back(), 1, 1e-12);
  EXPECT_EQ(told_.front(), "first");
  EXPECT_EQ(told_.back(), "third");
  expect_parts(read(out_ / "steps.pvd"), {"timestep=\"1\" file=\"states/first/solve/solution.vtu\"", "timestep=\"3\""});
  EXPECT_EQ(nlohmann::ordered_json::parse(read(state("second") / "run.json"))["state"], "second");
}

TEST_F(RunSequence, KeepsTheStatesBeforeAChange) {
  run_states();
  const std::string first = read(state("first") / "solve/solution.vtu");
  run_states({"sequence.second.tissues.1.youngs_modulus=2000"});
  EXPECT_EQ(statuses("first"), "kept kept kept");
  EXPECT_EQ(statuses("second"), "kept kept done");
  EXPECT_EQ(statuses("third"), "kept kept done");
  EXPECT_EQ(read(state("first") / "solve/solution.vtu"), first);
  run_states({"discretise.nodes=70"}, true);
  EXPECT_EQ(statuses("first"), "done done done");
  EXPECT_EQ(statuses("second"), "kept kept done") << "a stage that is shared is not made again";
  EXPECT_TRUE(fs::is_symlink(state("second") / "discretise"));
}

TEST_F(RunSequence, AStateThatFailsEndsItAndIsNamed) {
  const RunOutcome outcome = run_states({"solve.max_steps=3"});
  expect_parts(outcome.failure, {"state 'first': ", "not converged"});
  EXPECT_FALSE(fs::exists(state("second")));
}

TEST_F(RunSequence, PlaysNoSolutionsOfAnEarlierRun) {
  run_states();
  run_states({"solve.max_steps=3"});
  ASSERT_TRUE(fs::exists(state("third") / "solve/solution.vtu"));
  EXPECT_EQ(read(out_ / "steps.pvd").find("DataSet"), std::string::npos);
}

TEST_F(RunSequence, IsNotUpdated) {
  run_states();
  for (const fs::path& folder : {out_, state("second")}) {
    expect_parts(refusal([&] { UpdatedRun(folder, interruption_); }), {folder.string(), "it is of a sequence"});
  }
}

}  // namespace brainshift::pipelines::run_test
