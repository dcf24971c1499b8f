// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/write_text.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>

#include "tests/unit/file_size_limit.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::write_text_test {

TEST(WriteText, KeepsWhatWasThereWhereTheDiskIsFull) {
  const ScratchFolder folder;
  const auto file = folder.write("points.csv", "of before");
  {
    const FileSizeLimit full(1000);
    EXPECT_TRUE(throws_saying<std::runtime_error>([&] { write_text(file, std::string(2000, 'x')); },
                                                  {"points.csv", "could not be written whole"}));
  }
  EXPECT_EQ(bytes_of(file), "of before");
  constexpr auto mine = std::filesystem::perms::owner_read | std::filesystem::perms::owner_write;
  std::filesystem::permissions(file, mine);
  write_text(file, "of now");
  EXPECT_EQ(bytes_of(file), "of now");
  EXPECT_EQ(std::filesystem::status(file).permissions(), mine) << "nobody else may read it";
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "nothing half-written";
}

TEST(WriteText, TakesADeviceAndNoFolder) {
  const ScratchFolder folder;
  const auto pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  write_text(pipe, "text");
  std::array<char, 9> read{};
  EXPECT_EQ(::read(reader, read.data(), read.size()), 4);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  ::close(reader);
  EXPECT_TRUE(throws_saying<std::runtime_error>([&] { write_text(folder.path(), "text"); }, {"is a folder"}));
}

}  // namespace brainshift::test::write_text_test
