// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/number_table.hpp"

#include <gtest/gtest.h>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::test::number_table_test {

const std::vector<std::string> headers = {"x,y", "x,y,time"};

TEST(NumberTable, IsReadUnderAnyOfItsHeadersWithCommentsAside) {
  const ScratchFolder folder;
  const NumberTable table =
      read_number_table(folder.write("a.csv", "# made by\nx, y\n1, 2\n# so far\n-3,4e1\n"), headers);
  EXPECT_EQ(table.header, "x,y");
  EXPECT_EQ(table.rows, (std::vector<std::vector<double>>{{1, 2}, {-3, 40}}));
  EXPECT_EQ(table.line, (std::vector<std::size_t>{3, 5}));
  EXPECT_EQ(read_number_table(folder.write("b.csv", "x,y,time\n1,2,3\n"), headers).rows.front().size(), 3U);
  EXPECT_TRUE(read_number_table(folder.write("c.csv", "x,y\n"), headers).rows.empty());
}

TEST(NumberTable, IsRefusedWithFileAndLine) {
  const ScratchFolder folder;
  for (const auto& [text, said] : std::vector<std::pair<std::string, std::string>>{
           {"# c\ny,x\n1,2\n", "t.csv:2: the header x,y or x,y,time is expected here"},
           {"1,2\n", "t.csv:1: the header x,y or x,y,time is expected here"},
           {"# nothing\n", "t.csv:2: the header x,y or x,y,time is expected here"},
           {"x,y\n1,2\n3\n", "t.csv:3: 2 numbers x,y are expected, found \"3\""},
           {"x,y\n1,2,3\n", "t.csv:2: 2 numbers x,y are expected, found \"1,2,3\""},
           {"x,y\n1,\n", "t.csv:2: a finite number is expected"},
           {"x,y\n1,nan\n", "t.csv:2: a finite number is expected, found \"nan\""}}) {
    const std::string fault = refusal([&] { read_number_table(folder.write("t.csv", text), headers); });
    EXPECT_NE(fault.find(said), std::string::npos) << fault;
  }
}

}  // namespace brainshift::test::number_table_test
