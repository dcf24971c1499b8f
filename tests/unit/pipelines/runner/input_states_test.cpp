// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/input_states.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "pipelines/checksum/sha256.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::input_states_test {

class InputStatesTest : public RunFolder {
 protected:
  std::string fault_of(const fs::path& file) {
    return brainshift::test::refusal([&] { states_.check_unchanged(file); });
  }
  static void let_the_clock_tick() { usleep(30'000); }

  InputStates states_;
};

TEST_F(InputStatesTest, AFileThatNobodyTouchesIsUnchanged) {
  const fs::path file = write("load.csv", "x");
  EXPECT_EQ(states_.sha256(file), sha256_of_text("x"));
  EXPECT_EQ(fault_of(file), "");
}

TEST_F(InputStatesTest, RememberWhatAFileWasAtFirst) {
  const fs::path file = write("load.csv", "x");
  states_.sha256(file);
  write("load.csv", "y");
  EXPECT_EQ(states_.sha256(file), sha256_of_text("x"));
  brainshift::test::expect_parts(fault_of(file), {file.string(), "changed while it was read"});
}

TEST_F(InputStatesTest, AFileThatWasAnotherInTheMeantimeHasChanged) {
  const fs::path file = write("load.csv", "x");
  states_.sha256(file);
  let_the_clock_tick();
  write("load.csv", "y");
  write("load.csv", "x");
  EXPECT_NE(fault_of(file), "");
}

TEST_F(InputStatesTest, AFolderChangesWithAFileInIt) {
  write("dicom/1", "x");
  states_.sha256(folder_ / "dicom");
  EXPECT_EQ(fault_of(folder_ / "dicom"), "");
  write("dicom/2", "x");
  EXPECT_NE(fault_of(folder_ / "dicom"), "");
}

TEST_F(InputStatesTest, AFileThatIsGoneHasChanged) {
  const fs::path file = write("load.csv", "x");
  states_.sha256(file);
  fs::remove(file);
  brainshift::test::expect_parts(fault_of(file), {file.string(), "changed"});
}

}  // namespace brainshift::pipelines::input_states_test
