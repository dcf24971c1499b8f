// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/page_template.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace brainshift::pipelines::page_template_test {

using nlohmann::json;

// Without the lines and their indents that the printer begins between elements.
std::string filled(const char* page, const json& data) {
  std::string text = fill_page(page, data);
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at)) {
    text.erase(at, text.find_first_not_of(' ', at + 1) - at);
  }
  return text;
}

TEST(PageTemplate, FillsTextAndAttributesAndEscapesThem) {
  EXPECT_EQ(filled("<p class=\"a {{b}}\">x {{b}} y</p>", {{"b", "<\"&"}}),
            "<p class=\"a &lt;&quot;&amp;\">x &lt;\"&amp; y</p>");
}

TEST(PageTemplate, AValueIsNotFilledAgain) {
  EXPECT_EQ(filled("<p>{{a}}</p>", {{"a", "{{b}}"}}), "<p>{{b}}</p>");
}

TEST(PageTemplate, AnElementStandsOnceForEachItemInTheirOrder) {
  const json data = {{"rows", {{{"n", "1"}}, {{"n", "2"}}, {{"n", "3"}}}}};
  EXPECT_EQ(filled("<p>a<b each=\"rows\">{{n}}</b></p>", data), "<p>a<b>1</b><b>2</b><b>3</b></p>");
}

TEST(PageTemplate, AnElementStandsOnceForAnObjectOrForTrueAndNotForFalse) {
  const json data = {{"n", "out"}, {"object", {{"n", "in"}}}, {"yes", true}, {"no", false}};
  EXPECT_EQ(filled("<p>a<b each=\"object\">{{n}}</b></p>", data), "<p>a<b>in</b></p>");
  EXPECT_EQ(filled("<p>a<b each=\"yes\">{{n}}</b></p>", data), "<p>a<b>out</b></p>");
  EXPECT_EQ(filled("<p>a<b each=\"no\">{{n}}</b></p>", data), "<p>a</p>");
  EXPECT_EQ(filled("<p>a<b each=\"unheard of\">{{n}}</b></p>", data), "<p>a</p>");
}

TEST(PageTemplate, PicturesTakeTheirPlaceAndCommentsGo) {
  EXPECT_EQ(filled("<p>a<!-- b --><picture svg=\"s\"/>c</p>", {{"s", "<svg><g/></svg>"}}),
            "<p>a<svg><g></g></svg>c</p>");
}

TEST(PageTemplate, OnlyWhatHtmlKnowsAsEmptyHasNoEndTag) {
  EXPECT_EQ(filled("<p>a<td/><input/></p>", json::object()), "<p>a<td></td><input/></p>");
}

TEST(PageTemplate, RefusesWhatCannotBeFilled) {
  EXPECT_THROW(fill_page("<p>{{a}}</p>", json::object()), std::logic_error);
  EXPECT_THROW(fill_page("<p>{{a</p>", {{"a", "b"}}), std::logic_error);
  EXPECT_THROW(fill_page("<p>", json::object()), std::logic_error);
  EXPECT_THROW(fill_page("<p><picture svg=\"s\"/></p>", {{"s", "<svg>"}}), std::logic_error);
}

}  // namespace brainshift::pipelines::page_template_test
