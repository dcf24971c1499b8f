// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipelines/report/measure_table.hpp"
#include "pipelines/report/slice_figures.hpp"

namespace brainshift::pipelines {

/// What the page shows; parts that are empty are left out.
struct PageContent {
  nlohmann::json record;  ///< run.json
  bool has_image = false;
  double largest_displacement = 0;         ///< mm
  double arrow_factor = 1;                 ///< arrows are drawn so many times too long
  std::vector<Figure> comparisons = {};    ///< before, after, difference; three a plane
  std::vector<Figure> displacements = {};  ///< one a plane
  std::vector<Figure> labels = {};         ///< one a plane
  std::vector<Figure> surfaces = {};       ///< none or one
  std::vector<std::string> plots = {};     ///< SVG text
  std::size_t blink = 0;                   ///< index in comparisons of the "before" that fades into "after"
};

/// The whole page.
std::string make_page(PageContent content);

/// The text of page.html, to be filled.
const char* page_html();

}  // namespace brainshift::pipelines
