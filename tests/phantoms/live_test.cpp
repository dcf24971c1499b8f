// SPDX-License-Identifier: GPL-3.0-or-later
//
// A finished run that answers a load file whenever it changes, through the program.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "register/files/read_place_map.hpp"
#include "register/files/transform_files.hpp"
#include "segmentation/image/image.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/output/solution_file.hpp"
#include "tests/phantoms/program.hpp"

namespace brainshift::live_test {

namespace fs = std::filesystem;

constexpr const char* transform = "from-preop_to-intraop_mode-image_xfm.h5";

/// Asks until it is so, for five minutes.
template <class Condition>
bool comes_true(const Condition& condition) {
  for (int part = 0; part < 30000; ++part) {
    if (condition()) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return condition();
}

/// Whether a process has ended, be it that nobody has asked for its end yet.
bool ended(pid_t process) {
  const std::string status = bytes_of("/proc/" + std::to_string(process) + "/stat");
  const std::size_t name_end = status.rfind(')');
  return name_end == std::string::npos || status.compare(name_end, 3, ") Z") == 0;
}

/// By a transform, which is the identity outside its grid.
Points displacement_by(const fs::path& file, const Points& places) {
  const registration::PlaceMap map = registration::read_place_map(file);
  Points displacement(places.rows(), 3);
  for (Eigen::Index p = 0; p < places.rows(); ++p) {
    const Eigen::Vector3d x = places.row(p);
    displacement.row(p) = map(x).value_or(x) - x;
  }
  return displacement;
}

class Live : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch = std::make_unique<ScratchFolder>();
    const fs::path head = *scratch / "head";
    const ProgramResult made = run_shell("brainshift phantom --size 40 --spacing 4.8 --out " + head.string());
    ASSERT_EQ(made.code, 0) << made.err;
    const ProgramResult ran =
        run_shell("brainshift run " + (head / "scene.xml").string() + " --until solve --out " + run().string() +
                  " --set segment.edge_length=10 --set discretise.nodes=450 --quiet");
    ASSERT_EQ(ran.code, 0) << ran.err;
    load = solve::read_craniotomy_csv(head / "craniotomy.csv");
  }
  static void TearDownTestSuite() { scratch.reset(); }
  void TearDown() override {
    if (process_ > 0) {
      kill(process_, SIGKILL);
    }
  }

  static fs::path run() { return *scratch / "run"; }
  static fs::path load_file() { return *scratch / "load.csv"; }
  static fs::path answer(int number) {
    std::string name = std::to_string(number);
    name.insert(0, 6 - name.size(), '0');
    return run() / "live" / name;
  }
  static std::string said(const char* name) { return bytes_of(*scratch / name); }

  /// The whole file at once, as a careful program writes it.
  static void give(double factor) {
    solve::CraniotomyLoad changed = load;
    changed.displacement *= factor;
    solve::write_craniotomy_csv(*scratch / "next.csv", changed);
    fs::rename(*scratch / "next.csv", load_file());
  }
  /// In place, with pauses after half of the rows and within the last number, as a careless one does.
  static void give_slowly(double factor) {
    solve::CraniotomyLoad changed = load;
    changed.displacement *= factor;
    solve::write_craniotomy_csv(*scratch / "next.csv", changed);
    const std::string text = bytes_of(*scratch / "next.csv");
    const std::size_t half = text.find('\n', text.size() / 2) + 1, last = text.size() - 3;
    std::ofstream file(load_file(), std::ios::binary);
    for (const std::string& part : {text.substr(0, half), text.substr(half, last - half), text.substr(last)}) {
      file << part << std::flush;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  void start(const std::string& more = "") {
    const fs::path number = *scratch / "process";
    fs::remove(*scratch / "out");  // of the process before
    fs::remove(*scratch / "err");
    run_shell(BRAINSHIFT_PROGRAM " live " + run().string() + " --load " + load_file().string() + " " + more + " > " +
              (*scratch / "out").string() + " 2> " + (*scratch / "err").string() + " & echo $! > " + number.string());
    std::ifstream(number) >> process_;
    ASSERT_GT(process_, 0);
    ASSERT_TRUE(comes_true([] { return said("out").find("watching") != std::string::npos; })) << said("err");
  }
  void stop(int signal) {
    kill(process_, signal);
    ASSERT_TRUE(comes_true([this] { return ended(process_); }));
    process_ = 0;
  }
  double resident_megabytes() const {
    std::ifstream status("/proc/" + std::to_string(process_) + "/status");
    for (std::string line; std::getline(status, line);) {
      if (line.starts_with("VmRSS:")) {
        return std::atof(line.c_str() + 6) / 1024;
      }
    }
    return 0;
  }

  static std::unique_ptr<ScratchFolder> scratch;
  static solve::CraniotomyLoad load;
  pid_t process_ = 0;
};
std::unique_ptr<ScratchFolder> Live::scratch;
solve::CraniotomyLoad Live::load;

TEST_F(Live, AnswersEachChangePassesOverWhatIsBrokenAndGoesOnAfterAKill) {
  give(1.05);
  start("--image");
  ASSERT_TRUE(comes_true([] { return fs::exists(answer(1) / "warped.nii.gz"); })) << said("err");
  EXPECT_TRUE(fs::exists(answer(1) / transform));
  EXPECT_NE(said("out").find("error bound"), std::string::npos) << said("out");

  write_text(load_file(), "# frame: LPS\nx,y,z,ux,uy,uz\n1,2,");
  ASSERT_TRUE(comes_true([] { return said("err").find("passed over") != std::string::npos; }));
  give(0.95);
  ASSERT_TRUE(comes_true([] { return fs::exists(answer(2) / "warped.nii.gz"); })) << said("err");
  EXPECT_NE(bytes_of(answer(1) / transform), bytes_of(answer(2) / transform));

  give(1.02);  // killed at any time of the answer, or before it
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  stop(SIGKILL);
  start();
  give(1.01);
  ASSERT_TRUE(comes_true([] { return said("out").find("error bound") != std::string::npos; })) << said("err");
  stop(SIGTERM);
  EXPECT_TRUE(half_written(run()).empty());
  for (int number = 1; fs::exists(answer(number)); ++number) {
    EXPECT_TRUE(fs::exists(answer(number) / transform)) << number;
    EXPECT_TRUE(fs::exists(answer(number) / "load.csv")) << number;
  }
  EXPECT_TRUE(fs::exists(answer(3)));
}

TEST_F(Live, ASlowlyWrittenFileIsAnsweredOnceAndMovesNodesAsAnUpdateDoes) {
  fs::remove_all(run() / "live");
  fs::remove(load_file());
  start();
  give_slowly(1.2);
  ASSERT_TRUE(comes_true([] { return fs::exists(answer(1)); })) << said("err");
  EXPECT_EQ(bytes_of(answer(1) / "load.csv"), bytes_of(load_file()));
  const ProgramResult updated = run_shell("brainshift update " + run().string() + " --load " + load_file().string() +
                                          " --out " + (*scratch / "updated").string());
  ASSERT_EQ(updated.code, 0) << updated.err;
  give(1.1);
  ASSERT_TRUE(comes_true([] { return fs::exists(answer(2)); })) << said("err");
  EXPECT_EQ(bytes_of(answer(2) / "load.csv"), bytes_of(load_file())) << "nothing else was answered";
  EXPECT_EQ(said("err").find("passed over"), std::string::npos) << said("err");
  stop(SIGTERM);

  const Solution by_update = read_solution(*scratch / "updated/solve/solution.vtu");
  const Points of_run = read_solution(run() / "solve/solution.vtu").displacement;
  EXPECT_GT((by_update.displacement - of_run).rowwise().norm().maxCoeff(), 1) << "the load has changed something";
  const std::string name = std::string(registration::point_transform) + ".h5";
  const Points moved = displacement_by(answer(1) / name, by_update.positions);
  Eigen::VectorXd off = (moved - by_update.displacement).rowwise().norm();
  std::sort(off.begin(), off.end());
  EXPECT_LT(off.mean(), 0.04);  // at the rim of the load a grid of 2.5 mm is off by more
  EXPECT_LT(off[off.size() * 95 / 100], 0.15);
}

/// A second program would number its answers alike, and take the other's place. Answers for a run that was solved anew
/// would be of what it was.
TEST_F(Live, ASecondProgramOnOneRunAndANewSolveOfTheRunAreRefused) {
  give(1);
  start();
  const ProgramResult second =
      run_shell("timeout 60 " BRAINSHIFT_PROGRAM " live " + run().string() + " --load " + load_file().string());
  EXPECT_EQ(second.code, 1) << second.out;
  EXPECT_NE(second.err.find("another run is working in this folder"), std::string::npos) << second.err;
  const std::string text = bytes_of(load_file());
  write_text(*scratch / "next.csv", text.substr(0, text.size() - 1));
  fs::rename(*scratch / "next.csv", load_file());
  EXPECT_TRUE(comes_true([] { return said("err").find("the last line has no line end") != std::string::npos; }));
  fs::last_write_time(run() / "solve/stage.json", fs::file_time_type::clock::now());
  give(1.1);
  EXPECT_TRUE(comes_true([] { return said("err").find("the run was solved anew") != std::string::npos; }));
  stop(SIGTERM);
}

TEST_F(Live, AFolderInPlaceOfTheLoadIsRefusedAtOnce) {
  const ProgramResult said =
      run_shell("timeout 60 " BRAINSHIFT_PROGRAM " live " + run().string() + " --load " + run().string());
  EXPECT_NE(said.code, 0);
  EXPECT_NE(said.err.find("is a folder"), std::string::npos) << said.err;
}

TEST_F(Live, AnImageThatIsAnotherOneNowIsRefused) {
  const auto inputs = nlohmann::json::parse(bytes_of(run() / "run.json"))["inputs"];
  const auto t1 = std::ranges::find(inputs, "image.t1", [](const auto& input) { return input["role"]; });
  ASSERT_NE(t1, inputs.end());
  const fs::path file = (*t1)["path"].get<std::string>(),
                 away = file.parent_path() / ("away_" + file.filename().string());
  fs::rename(file, away);
  ScalarImage other = read_image(away);
  other.voxels.front() += 1;
  write_image(file, other);
  const ProgramResult said =
      run_shell("timeout 60 " BRAINSHIFT_PROGRAM " live " + run().string() + " --load " + load_file().string());
  fs::rename(away, file);
  EXPECT_NE(said.code, 0);
  EXPECT_NE(said.err.find("the image has changed since"), std::string::npos) << said.err;
}

TEST_F(Live, MemoryDoesNotGrow) {
  constexpr int updates = 60;  // tests/benchmark/live.py makes a thousand
  fs::remove_all(run() / "live");
  give(1);
  start();
  double early = 0;
  for (int number = 1; number <= updates; ++number) {
    ASSERT_TRUE(comes_true([number] { return fs::exists(answer(number)); })) << said("err");
    if (number == updates / 4) {
      early = resident_megabytes();
    }
    if (number < updates) {
      give(1 + 0.05 * std::sin(number));
    }
  }
  EXPECT_GT(early, 0);
  EXPECT_LT(resident_megabytes(), 1.05 * early);
  stop(SIGTERM);
}

}  // namespace brainshift::live_test
