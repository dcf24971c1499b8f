// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/commands/file_watch.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <future>
#include <string>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::file_watch_test {

using brainshift::test::refusal;
using brainshift::test::ScratchFolder;
namespace fs = std::filesystem;

void move_into_place(const ScratchFolder& folder, const std::string& text, const fs::path& file) {
  fs::rename(folder.write("load.part", text), file);
}

/// A writer that has yet to close the file.
std::ofstream begun(const fs::path& file, const std::string& text) {
  std::ofstream slow(file);
  slow << text << std::flush;
  return slow;
}

TEST(FileWatch, ReturnsEachVersionOnce) {
  const ScratchFolder folder;
  const fs::path file = folder.write("load.csv", "1\n");
  FileWatch watch(file);
  EXPECT_EQ(watch.next().size, 2);
  move_into_place(folder, "333", file);
  EXPECT_EQ(watch.next().size, 3);
  folder.write("load.csv", "4444");
  EXPECT_EQ(watch.next().size, 4);
  auto later = std::async(std::launch::async, [&] { return watch.next(); });
  EXPECT_EQ(later.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout);
  folder.write("other.csv", "666666");
  move_into_place(folder, "55555", file);
  EXPECT_EQ(later.get().size, 5);
}

/// As a copy that keeps the file's times, and a change of permissions, after which a file may be readable.
TEST(FileWatch, ReturnsWhatIsOfTheSameSizeAndTimeOrHasOtherPermissions) {
  const ScratchFolder folder;
  const fs::path file = folder.write("load.csv", "1\n");
  const fs::file_time_type time = fs::last_write_time(file);
  FileWatch watch(file);
  watch.next();
  folder.write("load.csv", "2\n");
  fs::last_write_time(file, time);
  EXPECT_EQ(watch.next().size, 2);
  fs::permissions(file, fs::perms::owner_read);
  EXPECT_EQ(watch.next().size, 2);
}

TEST(FileWatch, AWantOfANewlineAtTheEndIsTold) {
  const ScratchFolder folder;
  EXPECT_EQ(want_of_newline(folder.write("load.csv", "1\n")), "");
  EXPECT_NE(want_of_newline(folder.write("load.csv", "1\n2")).find("load.csv: the last line has no line end"),
            std::string::npos);
  EXPECT_EQ(want_of_newline(folder / "absent.csv"), "");
}

TEST(FileWatch, WaitsForAFileAndAFolderThatComeLater) {
  const ScratchFolder folder;
  const fs::path file = folder.path() / "later" / "load.csv";
  FileWatch watch(file);
  auto later = std::async(std::launch::async, [&] { return watch.next(); });
  EXPECT_EQ(later.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  fs::create_directory(file.parent_path());
  move_into_place(folder, "1\n", file);
  EXPECT_EQ(later.get().size, 2);
}

TEST(FileWatch, RefusesWhatIsNoFileOnceAndTakesTheFileThatComesInItsPlace) {
  const ScratchFolder folder;
  const fs::path file = folder.path() / "load.csv";
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  FileWatch watch(file);
  EXPECT_NE(refusal([&] { watch.next(); }).find("a pipe or a device"), std::string::npos);
  auto later = std::async(std::launch::async, [&] { return watch.next(); });
  EXPECT_EQ(later.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout);
  move_into_place(folder, "1\n", file);
  EXPECT_EQ(later.get().size, 2);
  fs::remove(file);
  fs::create_directory(file);
  EXPECT_NE(refusal([&] { watch.next(); }).find("is a folder"), std::string::npos);
}

/// With pauses at a line's end and within the last number; also one that began while the file before was answered.
TEST(FileWatch, WaitsForASlowWriter) {
  const ScratchFolder folder;
  const fs::path file = folder.path() / "load.csv";
  FileWatch watch(file);
  for (int version = 0; version < 2; ++version) {
    std::ofstream slow = begun(file, "1,2\n");
    auto later = std::async(std::launch::async, [&] { return watch.next(); });
    for (const char* more : {"3,-6", ".9\n", ""}) {
      EXPECT_EQ(later.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout) << "before " << more;
      slow << more << std::flush;
    }
    slow.close();
    EXPECT_EQ(later.get().size, 11);
  }
}

TEST(FileWatch, TakesWhatRestsUnclosedOnlyWithANewlineAtItsEnd) {
  const ScratchFolder folder;
  const fs::path file = folder.path() / "load.csv";
  FileWatch watch(file);
  std::ofstream slow = begun(file, "1,2\n");
  EXPECT_EQ(watch.next().size, 4);
  slow << "3,-6" << std::flush;
  EXPECT_NE(refusal([&] { watch.next(); }).find("load.csv: half-written"), std::string::npos);
  slow.close();
  EXPECT_EQ(watch.next().size, 8) << "closed as it was";
}

TEST(FileWatch, TakesAtOnceWhatIsMovedIntoPlace) {
  const ScratchFolder folder;
  const fs::path file = folder.path() / "load.csv";
  FileWatch watch(file);
  const std::ofstream slow = begun(file, "1,2");
  move_into_place(folder, "1,2\n3,-6.9", file);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(watch.next().size, 10);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1)) << "no wait for its writer";
}

}  // namespace brainshift::pipelines::file_watch_test
