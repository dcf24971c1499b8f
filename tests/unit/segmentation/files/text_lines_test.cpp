// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/text_lines.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::test::text_lines_test {

using Texts = std::vector<std::string>;

TEST(TextLines, AreTheSameWithEitherLineEndAndWithAByteOrderMark) {
  const ScratchFolder folder;
  const Texts lines = {"a, b", "", " c"};
  EXPECT_EQ(read_lines(folder.write("lf", "a, b\n\n c\n")), lines);
  EXPECT_EQ(read_lines(folder.write("crlf", "a, b\r\n\r\n c\r\n")), lines);
  EXPECT_EQ(read_lines(folder.write("cr", "a, b\r\r c\r")), lines) << "as old Macs write them";
  EXPECT_EQ(read_lines(folder.write("mark",
                                    "\xEF\xBB\xBF"
                                    "a, b\n\n c")),
            lines);
  EXPECT_EQ(read_lines(folder.write("blanks", "a, b\n\n c\n \t\n\n")), lines);
}

TEST(TextLines, OfAFileThatHoldsNoneAreRefusedWithItsName) {
  const ScratchFolder folder;
  const auto fault = [](const std::filesystem::path& file) { return refusal([&] { read_lines(file); }); };
  EXPECT_NE(fault(folder.write("empty.csv", "")).find("empty.csv"), std::string::npos);
  EXPECT_NE(fault(folder.write("blank.csv", " \n\r\n")).find("blank.csv: is empty"), std::string::npos);
  EXPECT_NE(fault(folder / "missing.csv").find("missing.csv"), std::string::npos);
  EXPECT_NE(fault(folder.path()).find("folder"), std::string::npos);
  ASSERT_EQ(mkfifo((folder / "pipe.csv").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", folder / "endless.csv");
  for (const char* name : {"pipe.csv", "endless.csv"}) {
    EXPECT_NE(fault(folder / name).find("is a folder, a pipe or a device"), std::string::npos) << name;
  }
}

TEST(TextLines, TrimmedTextKeepsTheBlanksWithin) {
  EXPECT_EQ(trimmed(" \ta b\t "), "a b");
  EXPECT_EQ(trimmed("ab"), "ab");
  EXPECT_EQ(trimmed(" \t "), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(TextLines, FieldsInQuotesHoldCommasAndQuotes) {
  EXPECT_EQ(split_fields("a, b ,,c"), (Texts{"a", "b", "", "c"}));
  EXPECT_EQ(split_fields(R"("left, upper",1)"), (Texts{"left, upper", "1"}));
  EXPECT_EQ(split_fields(R"(1,"he said ""no"", twice",2)"), (Texts{"1", "he said \"no\", twice", "2"}));
  EXPECT_EQ(split_fields(R"("",x)"), (Texts{"", "x"}));
  EXPECT_EQ(split_fields("a,"), (Texts{"a", ""}));
  EXPECT_EQ(split_fields(""), (Texts{""}));
}

TEST(TextLines, RawFieldsJoinedAgainAreTheLine) {
  for (const std::string line : {"a, b ,,c", R"( "x, y" ,"a ""b""",)", "", ",", "\"open, quote"}) {
    const std::vector<std::string_view> raw = split_raw_fields(line);
    EXPECT_EQ(raw.size(), split_fields(line).size()) << line;
    std::string joined(raw.front());
    for (std::size_t i = 1; i < raw.size(); ++i) {
      joined += ',';
      joined += raw[i];
    }
    EXPECT_EQ(joined, line);
  }
}

TEST(TextLines, AQuotedFieldIsReadAsItWas) {
  for (const std::string text : {"plain", "gyrus, \"left\"", "", "\""}) {
    EXPECT_EQ(split_fields(quoted_field(text) + ",next"), (std::vector<std::string>{text, "next"}));
  }
}

TEST(TextLines, ANumberIsTheWholeFieldAndFinite) {
  EXPECT_EQ(parse_number("-1.5e-3", "t.csv", 7), -1.5e-3);
  EXPECT_EQ(parse_number("+2", "t.csv", 7), 2.0);
  for (const char* const field : {"", "1,5", "1 5", "1.5mm", "nan", "inf", "1e999", "+-1", "0x10", "--1"}) {
    const std::string sentence = refusal([&] { parse_number(field, "t.csv", 7); });
    EXPECT_EQ(sentence, std::string("t.csv:7: a finite number is expected, found \"") + field + "\"");
  }
}

}  // namespace brainshift::test::text_lines_test
