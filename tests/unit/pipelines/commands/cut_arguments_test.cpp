// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/commands/cut_arguments.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::cut_arguments_test {

using brainshift::test::expect_parts;
using brainshift::test::refusal;

/// What a command line says to a job in a plane or in space.
struct Said {
  Scene scene;
  SolveJob job;
};

Said said(std::vector<std::string> words, solve::Plane plane) {
  Said result;
  result.job.plane = plane;
  CutArguments arguments;
  CLI::App command;
  add_cut_options(command, result.scene, arguments);
  std::reverse(words.begin(), words.end());  // as CLI11 wants them
  command.parse(words);
  read_cut_arguments(arguments, result.scene, result.job);
  return result;
}

std::string fault(const std::vector<std::string>& words, solve::Plane plane) {
  return refusal([&] { said(words, plane); });
}

TEST(CutArguments, ThatSayNothingCutNothing) {
  for (const solve::Plane plane : {solve::Plane::none, solve::Plane::strain}) {
    const Said nothing = said({}, plane);
    EXPECT_FALSE(nothing.scene.cuts);
    EXPECT_FALSE(nothing.scene.resection);
    EXPECT_TRUE(nothing.job.cut_paths.empty());
    EXPECT_FALSE(nothing.job.rupture);
  }
}

TEST(CutArguments, GiveEachCutTheOneTiming) {
  const Said two = said({"--cut", "a.vtp", "--cut", "b.stl", "--cut-start", "0.25", "--cut-speed", "40",
                         "--cut-direction", "0 0 -1", "--cut-contact", "yes"},
                        solve::Plane::none);
  ASSERT_TRUE(two.scene.cuts);
  EXPECT_TRUE(two.scene.cuts->contact);
  ASSERT_EQ(two.scene.cuts->files.size(), 2U);
  EXPECT_EQ(two.scene.cuts->files[1].file, "b.stl");
  for (const CutFile& cut : two.scene.cuts->files) {
    EXPECT_EQ(cut.timing.start, 0.25);
    EXPECT_EQ(cut.timing.speed, 40);
    EXPECT_EQ(cut.timing.direction, Eigen::Vector3d(0, 0, -1));
  }
}

TEST(CutArguments, GivePathsAndARuptureToAPlaneProblem) {
  const Said torn = said({"--cut-path", "0,50; 30,50", "--cut-start", "0.5", "--rupture", "stretch=1.4,seed=3",
                          "--weak-spot", "1,2,3,0.5", "--weak-spot", "4,5,6,0.7"},
                         solve::Plane::stress);
  ASSERT_EQ(torn.job.cut_paths.size(), 1U);
  EXPECT_EQ(torn.job.cut_paths[0].vertices.row(1), Eigen::RowVector3d(30, 50, 0));
  EXPECT_EQ(torn.job.cut_paths[0].time, (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(torn.job.rupture->strength, 1.4);
  ASSERT_EQ(torn.job.rupture->weak_spots.size(), 2U);
  EXPECT_EQ(torn.job.rupture->weak_spots[1].place, Eigen::Vector2d(4, 5));
  EXPECT_FALSE(torn.scene.cuts) << "they are in no file";
}

TEST(CutArguments, TakeOutTissueUnderPressure) {
  const Said taken = said({"--resection", "2 3", "--resection-pressure", "50"}, solve::Plane::none);
  ASSERT_TRUE(taken.scene.resection);
  EXPECT_EQ(taken.scene.resection->labels, (std::vector<std::int32_t>{2, 3}));
  EXPECT_EQ(taken.scene.resection->pressure, 50);
  EXPECT_THROW(said({"--resection-pressure", "50"}, solve::Plane::none), CLI::RequiresError) << "of what?";
}

TEST(CutArguments, RefuseWhatMakesNoSenseByItsOption) {
  const solve::Plane space = solve::Plane::none, plane = solve::Plane::strain;
  expect_parts(fault({"--cut-path", "0,0; 1,1"}, space), {"--cut-path cuts a plane problem", "--plane", "--cut"});
  expect_parts(fault({"--rupture", "stretch=1.4"}, space), {"--rupture is for plane problems", "--plane"});
  expect_parts(fault({"--cut-path", "0,0; 1"}, plane), {"--cut-path is '0,0; 1'", "points x,y in mm"});
  expect_parts(fault({"--cut-path", "0,0; 0,0"}, plane), {"--cut-path '0,0; 0,0'"});
  expect_parts(fault({"--rupture", "stretch=0.5"}, plane), {"stretch", "'0.5'"});
  for (const char* option : {"--cut-start", "--cut-speed"}) {
    expect_parts(fault({option, "1"}, space), {"there is no cut to which", "give a --cut"});
  }
  expect_parts(fault({"--cut-direction", "0 0 1"}, space), {"there is no cut to which"});
  expect_parts(fault({"--cut-contact", "no"}, plane), {"there is no cut to which"});
}

TEST(CutArguments, ThatATableDoesNotAllowAreErrorsOfTheCommandLine) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"--cut", "a.vtp", "--cut-start", "-1"},
                                             {"--cut", "a.vtp", "--cut-speed", "0"},
                                             {"--cut", "a.vtp", "--cut-contact", "maybe"},
                                             {"--weak-spot", "1,2,3,0.5"}}) {
    EXPECT_THROW(said(words, solve::Plane::none), CLI::ParseError) << words.back();
  }
}

}  // namespace brainshift::pipelines::cut_arguments_test
