// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/folder_lock.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::folder_lock_test {

class FolderLockTest : public RunFolder {
 protected:
  std::string fault_of(const fs::path& folder) const {
    try {
      const FolderLock lock(folder);
    } catch (const std::runtime_error& fault) {
      return fault.what();
    }
    return {};
  }
};

TEST_F(FolderLockTest, HoldsAFolderUntilItGoes) {
  const fs::path folder = folder_ / "deep/out";
  std::optional<FolderLock> lock(folder);
  brainshift::test::expect_parts(fault_of(folder), {folder.string(), "another run is working in this folder"});
  EXPECT_EQ(fault_of(folder_ / "other"), "");
  lock.reset();
  EXPECT_EQ(fault_of(folder), "");
}

TEST_F(FolderLockTest, OfAFolderThatWasRenamedDoesNotHoldTheNewOne) {
  const FolderLock lock(folder_ / "out");
  fs::rename(folder_ / "out", folder_ / "moved");
  EXPECT_EQ(fault_of(folder_ / "out"), "");
}

TEST_F(FolderLockTest, CannotHoldAFile) {
  write("file", "x");
  brainshift::test::expect_parts(fault_of(folder_ / "file"), {(folder_ / "file").string()});
}

}  // namespace brainshift::pipelines::folder_lock_test
