// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/external_command.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>

#include "pipelines/runner/stage_folder.hpp"
#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::external_command_test {

class ExternalCommandTest : public RunFolder {};

TEST_F(ExternalCommandTest, ACommandSeesItsFoldersWhateverTheirNames) {
  const fs::path out = folder_ / "it's out";
  fs::create_directories(out);
  run_external_command({"echo {in} > {out}/said", folder_ / "in here", out, folder_}, interruption_);
  EXPECT_EQ(read(out / "said"), (folder_ / "in here").string() + "\n");
}

TEST_F(ExternalCommandTest, AFoldersNameCannotBreakOutOfItsQuotes) {
  const fs::path out = folder_ / "inj{out};touch broken;{in}";
  fs::create_directories(out);
  run_external_command({"ls -d {out} > said; echo {in} >> said", out / "in", out, folder_}, interruption_);
  EXPECT_EQ(read(folder_ / "said"), out.string() + "\n" + (out / "in").string() + "\n");
  EXPECT_FALSE(fs::exists(folder_ / "broken"));
}

TEST_F(ExternalCommandTest, AFailedCommandIsAFaultWithItsCodeAndLastWords) {
  try {
    run_external_command({"echo first; echo no mesh >&2; exit 7", folder_, folder_, folder_}, interruption_);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("code 7"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("no mesh"), std::string::npos) << error.what();
  }
}

TEST_F(ExternalCommandTest, ACommandThatAsksIsGivenNoAnswer) {
  int answers[2];
  ASSERT_EQ(::pipe(answers), 0);
  ASSERT_EQ(::write(answers[1], "yes\n", 4), 4);
  const int own = ::dup(STDIN_FILENO);
  ::dup2(answers[0], STDIN_FILENO);
  run_external_command({"read answer || echo none > said", folder_, folder_, folder_}, interruption_);
  ::dup2(own, STDIN_FILENO);
  for (const int file : {own, answers[0], answers[1]}) {
    ::close(file);
  }
  EXPECT_EQ(read(folder_ / "said"), "none\n");
}

TEST_F(ExternalCommandTest, ACommandWhoseEndNobodyToldIsAFault) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_THROW(run_external_command({"exit 7", folder_, folder_, folder_}, interruption_), std::runtime_error);
  std::signal(SIGCHLD, before);
}

}  // namespace brainshift::pipelines::external_command_test
