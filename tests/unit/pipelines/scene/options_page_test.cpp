// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/options_page.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "pipelines/scene/scene_table.hpp"
#include "pipelines/scene/tissue_table.hpp"

namespace brainshift::pipelines::options_page_test {

TEST(OptionsPage, IsTheOneThatIsCommitted) {
  std::ostringstream committed;
  committed << std::ifstream(BRAINSHIFT_SCENE_SOURCES "/OPTIONS.md").rdbuf();
  EXPECT_TRUE(committed.str() == options_page())
      << "pipelines/scene/OPTIONS.md is not what the table of options says; write it again with\n"
         "  build/pipelines/brainshift scene --options > pipelines/scene/OPTIONS.md";
}

TEST(OptionsPage, NamesEveryOptionOnce) {
  const std::string page = options_page();
  std::size_t options = tissue_options().size() + cut_options().size();
  for (const Element& element : scene_elements()) {
    options += element.options.size();
  }
  std::size_t items = 0;
  for (std::size_t at = page.find("\n- `"); at != std::string::npos; at = page.find("\n- `", at + 1)) {
    ++items;
  }
  EXPECT_EQ(items, options);
}

TEST(OptionsPage, HasNoLineOver120Characters) {
  std::istringstream page(options_page());
  for (std::string line; std::getline(page, line);) {
    EXPECT_LE(line.size(), 120U) << line;
  }
}

}  // namespace brainshift::pipelines::options_page_test
