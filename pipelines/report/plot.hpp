// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace brainshift::pipelines {

/// Points of a plot, with straight lines between them or alone.
struct Series {
  std::string name;
  std::vector<double> x, y;
  bool joined = true;
};

struct Plot {
  std::string file;  ///< without .png
  std::string title, x_label, y_label;
  std::vector<Series> series;
  bool logarithmic = false;  ///< both axes
};

/// Draws a plot to folder/file.png. Throws std::runtime_error, naming the file, when it cannot be written.
void draw(const std::filesystem::path& folder, const Plot& plot);

}  // namespace brainshift::pipelines
