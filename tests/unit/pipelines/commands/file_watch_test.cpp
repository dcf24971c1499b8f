// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/commands/file_watch.hpp"

#include <gtest/gtest.h>

#include <future>
#include <string>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::file_watch_test {

using brainshift::test::ScratchFolder;
namespace fs = std::filesystem;

void move_into_place(const ScratchFolder& folder, const std::string& text, const fs::path& file) {
  fs::rename(folder.write("load.part", text), file);
}

TEST(FileWatch, ReturnsEachVersionOnce) {
  const ScratchFolder folder;
  const fs::path file = folder.write("load.csv", "1");
  FileWatch watch(file);
  EXPECT_EQ(watch.next().size, 1);
  move_into_place(folder, "22", file);
  EXPECT_EQ(watch.next().size, 2);
  folder.write("load.csv", "333");
  EXPECT_EQ(watch.next().size, 3);
  auto later = std::async(std::launch::async, [&] { return watch.next(); });
  EXPECT_EQ(later.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout);
  folder.write("other.csv", "55555");
  move_into_place(folder, "4444", file);
  EXPECT_EQ(later.get().size, 4);
}

TEST(FileWatch, WaitsForAFileAndAFolderThatComeLater) {
  const ScratchFolder folder;
  const fs::path file = folder.path() / "later" / "load.csv";
  FileWatch watch(file);
  auto later = std::async(std::launch::async, [&] { return watch.next(); });
  EXPECT_EQ(later.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  fs::create_directory(file.parent_path());
  move_into_place(folder, "1", file);
  EXPECT_EQ(later.get().size, 1);
}

}  // namespace brainshift::pipelines::file_watch_test
