// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::scratch_folder_test {

/// A folder of temporary files of its own.
class ScratchFolderTest : public RunFolder {
 protected:
  void SetUp() override {
    before_ = fs::temp_directory_path();
    setenv("TMPDIR", folder_.c_str(), 1);
  }
  void TearDown() override { setenv("TMPDIR", before_.c_str(), 1); }

 private:
  fs::path before_;
};

TEST_F(ScratchFolderTest, GoesWithWhatIsInIt) {
  fs::path place;
  {
    const ScratchFolder scratch(interruption_);
    place = scratch.path();
    EXPECT_EQ(place.parent_path(), folder_);
    fs::create_directories(place / "run/solve");
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(ScratchFolderTest, ClearsUpWhatWasAbandonedAndNothingElse) {
  write("brainshift_scratch_killed/.unfinished", "");
  write("brainshift_scratch_killed/run/run.json", "{}");
  write("brainshift_scratch_foreign/mine", "mine");
  write("other/.unfinished", "");
  const ScratchFolder in_use(interruption_);
  const ScratchFolder scratch(interruption_);
  EXPECT_TRUE(fs::exists(in_use.path()));
  EXPECT_FALSE(fs::exists(folder_ / "brainshift_scratch_killed"));
  EXPECT_TRUE(fs::exists(folder_ / "brainshift_scratch_foreign/mine"));
  EXPECT_TRUE(fs::exists(folder_ / "other/.unfinished"));
}

TEST_F(ScratchFolderTest, SaysWhereNoneCanBeMade) {
  setenv("TMPDIR", (folder_ / "missing").c_str(), 1);
  EXPECT_ANY_THROW(ScratchFolder{interruption_});
}

}  // namespace brainshift::pipelines::scratch_folder_test
