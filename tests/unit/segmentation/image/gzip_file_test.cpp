// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/gzip_file.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <random>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::test::gzip_file_test {

constexpr std::size_t block = std::size_t{1} << 20;

/// Bytes of which half do not compress.
std::string some_bytes(std::size_t size) {
  std::mt19937 random(7);
  std::string bytes(size, 'a');
  for (std::size_t i = 0; i < size; i += 2) {
    bytes[i] = static_cast<char>(random());
  }
  return bytes;
}

std::string text_of(const std::vector<std::uint8_t>& bytes) {
  return {bytes.begin(), bytes.end()};
}

TEST(GzipFile, GivesBackTheBytesWhereverTheBlocksEnd) {
  const ScratchFolder folder;
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, block - 1, block, block + 1, 2 * block + 333}) {
    const std::string bytes = some_bytes(size);
    write_gzip(folder / "a.gz", folder.write("a", bytes));
    EXPECT_TRUE(text_of(uncompressed(folder / "a.gz", size)) == bytes) << size;
  }
}

TEST(GzipFile, IsSmallerThanWhatRepeatsItself) {
  const ScratchFolder folder;
  write_gzip(folder / "a.gz", folder.write("a", std::string(block, 'x')));
  EXPECT_LT(std::filesystem::file_size(folder / "a.gz"), block / 100);
}

TEST(GzipFile, DoesNotDependOnTheNumberOfThreads) {
  const ScratchFolder folder;
  const auto plain = folder.write("a", some_bytes(3 * block));
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  write_gzip(folder / "one.gz", plain);
  omp_set_num_threads(3);
  write_gzip(folder / "three.gz", plain);
  omp_set_num_threads(threads);
  EXPECT_TRUE(bytes_of(folder / "one.gz") == bytes_of(folder / "three.gz"));
}

TEST(GzipFile, ThatIsNotCompressedIsReadAsItIs) {
  const ScratchFolder folder;
  EXPECT_EQ(text_of(uncompressed(folder.write("plain", "some text"), 9)), "some text");
}

TEST(GzipFile, ThatIsCutShortOrDamagedIsRefused) {
  const ScratchFolder folder;
  write_gzip(folder / "a.gz", folder.write("a", some_bytes(5000)));
  const std::string whole = bytes_of(folder / "a.gz");
  const auto fault = [&](const std::string& bytes) {
    return refusal([&] { uncompressed(folder.write("b.gz", bytes), 5000); });
  };
  EXPECT_EQ(fault(whole), "");
  EXPECT_NE(fault(whole.substr(0, whole.size() / 2)).find("b.gz: the compressed data are cut short"),
            std::string::npos);
  EXPECT_NE(fault(whole.substr(0, whole.size() - 3)).find("b.gz"), std::string::npos);
  for (const std::size_t place : {whole.size() / 2, whole.size() - 8}) {  // in the data, in the checksum
    std::string damaged = whole;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x10);
    EXPECT_NE(fault(damaged).find("b.gz"), std::string::npos) << place;
  }
  EXPECT_NE(refusal([&] { uncompressed(folder / "missing.gz", 1); }).find("missing.gz"), std::string::npos);
}

TEST(GzipFile, ThatCannotBeWrittenIsAFaultOfOutput) {
  const ScratchFolder folder;
  EXPECT_THROW(write_gzip(folder / "none" / "a.gz", folder.write("a", "text")), std::runtime_error);
}

}  // namespace brainshift::test::gzip_file_test
