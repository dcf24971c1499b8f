// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "pipelines/report/measure_table.hpp"

namespace brainshift::pipelines {

/// Text with the characters that mean something in HTML written out.
std::string escape(const std::string& text);

/// A picture of the page.
struct PageFigure {
  std::string name;
  std::string alt;
  int width;        ///< pixels
  std::string png;  ///< the file's bytes
};

/// An <img> that holds its picture; beside others in a row it takes space in proportion to its width.
std::string image_element(const PageFigure& figure);

std::string measures_html(std::span<const MeasureRow> rows);

/// One row a stage: how it ended, seconds, peak memory, sizes.
std::string stages_html(const nlohmann::json& record);

/// The effective options, one row an element of the scene.
std::string options_html(const nlohmann::json& record);

/// Every measure of every stage as run.json has it.
std::string all_measures_html(const nlohmann::json& record);

/// The page's style sheet.
std::string style_sheet();

}  // namespace brainshift::pipelines
