// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/checksum/sha256.hpp"

#include <gtest/gtest.h>

#include <array>

#include "pipelines/runner/stage_folder.hpp"
#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::sha256_test {

class Sha256Test : public RunFolder {};

TEST_F(Sha256Test, Sha256GivesThePublishedDigests) {
  EXPECT_EQ(sha256_of_text(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of_text("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_text("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST_F(Sha256Test, Sha256AgreesWithSha256sumAtEveryPadding) {
  for (const std::size_t size : {1U, 55U, 56U, 63U, 64U, 65U, 119U, 120U, 1000000U}) {
    const fs::path file = write("data", std::string(size, 'q'));
    FILE* pipe = popen(("sha256sum " + file.string()).c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::array<char, 65> digest{};
    ASSERT_NE(std::fgets(digest.data(), digest.size(), pipe), nullptr);
    pclose(pipe);
    EXPECT_EQ(sha256_of_file(file), digest.data()) << size << " bytes";
  }
}

}  // namespace brainshift::pipelines::sha256_test
