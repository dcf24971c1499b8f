// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/commands/printable.hpp"

#include <gtest/gtest.h>

namespace brainshift::pipelines::printable_test {

TEST(Printable, LeavesTextsOfAnyLanguageAsTheyAre) {
  for (const char* text : {"", "brain.vtp: no such file", "Schädel.nii.gz", "脳.nii", "a\U0001F9E0b"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, ControlsNoTerminal) {
  using namespace std::string_literals;
  EXPECT_EQ(printable("a\x1b[31mred\x07\x7f"), "a?[31mred??");
  EXPECT_EQ(printable("one\ntwo\r\tthree"), "one two  three");
  EXPECT_EQ(printable("nul\0l"s), "nul?l");
  EXPECT_EQ(printable("C1 \xc2\x9b"
                      "31m"),
            "C1 ??31m");
}

TEST(Printable, ShowsWhatIsNoUtf8AsQuestionMarks) {
  EXPECT_EQ(printable("\x9b"
                      "31m \xff\xc3"),
            "?31m ??");
  EXPECT_EQ(printable("cut \xe8\x84"), "cut ??");
}

TEST(Printable, CutsAVeryLongTextInItsMiddle) {
  const std::string text = printable("FILE: found \"" + std::string(1'000'000, 'x') + "\"; write a number");
  EXPECT_LT(text.size(), 5100U);
  EXPECT_TRUE(text.starts_with("FILE: found"));
  EXPECT_TRUE(text.ends_with("write a number"));
  std::string umlauts;
  for (int i = 0; i < 10'000; ++i) {
    umlauts += "ä";
  }
  const std::string begins = umlauts.substr(0, 1000) + "x" + umlauts;
  EXPECT_EQ(printable(begins).find('?'), std::string::npos);
  EXPECT_EQ(printable(printable(begins)).find('?'), std::string::npos) << "a character was cut in two";
}

}  // namespace brainshift::pipelines::printable_test
