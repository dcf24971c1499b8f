// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/tradeoff/sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/pipelines/ball_folder.hpp"

namespace brainshift::pipelines::sweep_test {

using brainshift::test::refusal;

/// With lists of what is tried.
class SweepTest : public BallFolder {
 protected:
  fs::path scene(const std::string& nodes, const std::string& reference, const std::string& more = "") const {
    return write("scene.xml", R"(<scene version="1"><image surface="ball.vtp"/>
      <tissues><tissue label="1" material="brain"/></tissues>
      <load><craniotomy file="load.csv"/></load>)" +
                                  more + R"(<tradeoff nodes=")" + nodes +
                                  R"(" points_per_cell="1" basis="linear" derivatives="full" precision="double"
      tolerance="0.005" reference_nodes=")" +
                                  reference + R"("/></scene>)");
  }
  Sweep run_sweep(const fs::path& file, const std::vector<std::string>& overrides = {}) {
    return sweep(file, overrides, folder_ / "out", interruption_,
                 [this](std::size_t done, std::size_t all, const TradeoffPoint& point) {
                   EXPECT_EQ(done, ++told_);
                   EXPECT_LE(done, all);
                   last_ = point;
                 });
  }

  std::size_t told_ = 0;
  TradeoffPoint last_;
};

TEST_F(SweepTest, MeasuresEachChoiceAgainstTheReference) {
  press_unevenly();
  const Sweep result = run_sweep(scene("40 640", "1300"), {"discretise.craniotomy_factor=1"});
  EXPECT_EQ(result.reference.front(), "1300");
  ASSERT_EQ(result.points.size(), 2U);
  EXPECT_EQ(told_, 2U);
  EXPECT_EQ(last_.choice, result.points.back().choice);
  for (const TradeoffPoint& point : result.points) {
    EXPECT_EQ(point.failure, "");
    const double wanted = std::stod(point.choice.front());
    EXPECT_NEAR(static_cast<double>(point.nodes), wanted, 0.05 * wanted);
    EXPECT_GT(point.points, point.nodes / 4);
    EXPECT_GT(point.steps, 0);
    EXPECT_GT(point.error.largest, point.error.mean);
    EXPECT_GT(point.error.mean, 0);
    EXPECT_LT(point.error.mean, 1) << "the load is 1 mm";
    EXPECT_TRUE(std::isnan(point.landmark_error)) << "the scene has none";
    EXPECT_GE(point.whole_seconds, point.solve_seconds);
  }
  EXPECT_LT(result.points[1].error.mean, result.points[0].error.mean);
}

TEST_F(SweepTest, DoesNotSolveAgainWhatIsThereOfTheSameScene) {
  const fs::path file = scene("40", "80");
  const Sweep first = run_sweep(file);
  const fs::path kept = folder_ / "out/points" / (name_of(first.points[0].choice) + ".json");
  ASSERT_TRUE(fs::exists(kept));
  const std::string text = read(kept);
  told_ = 0;
  const Sweep second = run_sweep(file);
  EXPECT_EQ(second.points[0].solve_seconds, first.points[0].solve_seconds);
  EXPECT_EQ(second.points[0].error.mean, first.points[0].error.mean);
  EXPECT_EQ(read(kept), text);
  told_ = 0;
  run_sweep(file, {"load.depth=4"});
  EXPECT_NE(read(kept), text) << "of another load";
}

/// What was at fault may have passed.
TEST_F(SweepTest, TriesAPointAgainThatWasRefused) {
  const fs::path foreign = folder_ / "out/run/solve";
  fs::create_directories(foreign);
  write((foreign / "mine.txt").string(), "");
  const fs::path file = scene("40", "80");
  EXPECT_NE(run_sweep(file).points[0].failure, "");
  fs::remove_all(foreign);
  told_ = 0;
  EXPECT_EQ(run_sweep(file).points[0].failure, "");
}

TEST_F(SweepTest, RefusesAReferenceThatIsNoFinerThanTheChoices) {
  const std::string sentence = refusal([&] { run_sweep(scene("150 400", "799")); });
  EXPECT_NE(sentence.find("scene.xml:"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("twice as many"), std::string::npos) << sentence;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(SweepTest, RefusesAStageThatIsAnExternalCommand) {
  const std::string sentence =
      refusal([&] { run_sweep(scene("40", "80", R"(<stage name="solve" command="true"/>)")); });
  EXPECT_NE(sentence.find("external command"), std::string::npos) << sentence;
}

}  // namespace brainshift::pipelines::sweep_test
