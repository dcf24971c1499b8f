// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/own_folder.hpp"

#include <gtest/gtest.h>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::own_folder_test {

class OwnFolderTest : public RunFolder {};

TEST_F(OwnFolderTest, IsEmptyOrMarked) {
  fs::create_directories(folder_ / "empty");
  write("finished/stage.json", "{}");
  write("unfinished/.unfinished", "");
  for (const char* name : {"empty", "finished", "unfinished", "missing"}) {
    EXPECT_EQ(is_own_folder(folder_ / name), name != std::string("missing")) << name;
    EXPECT_NO_THROW(refuse_foreign_folder(folder_ / name)) << name;
  }
}

TEST_F(OwnFolderTest, IsNoFileNoLinkAndNoFolderOfSomebodyElse) {
  write("foreign/mine", "mine");
  write("file", "mine");
  write("marked/stage.json", "{}");
  fs::create_directory_symlink(folder_ / "marked", folder_ / "link");
  for (const char* name : {"foreign", "file", "link"}) {
    brainshift::test::expect_parts(brainshift::test::refusal([&] { refuse_foreign_folder(folder_ / name); }),
                                   {(folder_ / name).string(), "not made by brainshift"});
  }
}

TEST_F(OwnFolderTest, GoesWithAllThatIsInIt) {
  write("stage/stage.json", "{}");
  write("stage/steps/one", "1");
  clear_own_folder(folder_ / "stage");
  EXPECT_TRUE(fs::is_empty(folder_ / "stage"));
  write("stage/steps/one", "1");
  remove_own_folder(folder_ / "stage");
  EXPECT_FALSE(fs::exists(folder_ / "stage"));
}

}  // namespace brainshift::pipelines::own_folder_test
