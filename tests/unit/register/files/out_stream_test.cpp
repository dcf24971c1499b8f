// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/out_stream.hpp"

#include <gtest/gtest.h>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::out_stream_test {

TEST(OutStream, LeavesWhatWasThereUntilItIsFinished) {
  const test::ScratchFolder folder;
  const auto file = folder.write("tracts.tck", "of before");
  { OutStream(file).write("half", 4); }
  EXPECT_EQ(test::bytes_of(file), "of before");
  OutStream whole(file);
  whole.write("of now", 6);
  EXPECT_EQ(test::bytes_of(file), "of before");
  whole.finish();
  EXPECT_EQ(test::bytes_of(file), "of now");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "nothing half-written";
}

}  // namespace brainshift::registration::out_stream_test
