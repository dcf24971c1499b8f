// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipelines/report/measure_table.hpp"
#include "pipelines/report/viewer_data.hpp"

namespace brainshift::pipelines {

/// What the page shows; parts that are empty are left out.
struct PageContent {
  nlohmann::json record;      ///< run.json
  std::string no_image = {};  ///< why nothing is shown before and after; empty: it is
  bool has_opening = false;
  double largest_displacement = 0;          ///< mm
  double arrow_factor = 1;                  ///< arrows are drawn so many times too long
  std::vector<Figure> comparisons = {};     ///< before, after, difference; three a plane
  std::vector<Figure> displacements = {};   ///< one a plane
  std::vector<Figure> uncertainties = {};   ///< one a plane
  std::vector<Figure> labels = {};          ///< one a plane
  std::vector<Figure> surfaces = {};        ///< none or one
  std::vector<Figure> weights = {};         ///< none or one
  ViewerData viewer = {};                   ///< without an array where there is no image
  std::vector<PackedBytes> libraries = {};  ///< of viewer.js
};

/// The whole page.
std::string make_page(PageContent content);

/// The text of page.html, to be filled.
const char* page_html();

/// The text of viewer_run.js and viewer.js.
const char* viewer_script();

/// What viewer.js calls, with its licences; empty where the packages of npm were not there when the program was built.
const std::vector<PackedBytes>& viewer_libraries();

}  // namespace brainshift::pipelines
