// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace brainshift::pipelines {

/// Points of a plot, with straight lines between them or alone. A point that is not finite, or not positive on a
/// logarithmic axis, is left out.
struct Series {
  std::string name;
  std::vector<double> x, y;
  bool joined = true;
};

enum class Scale : std::uint8_t { linear, log_log };

struct Plot {
  std::string file;  ///< without .svg
  std::string title, x_label, y_label;
  std::vector<Series> series;
  Scale scale = Scale::linear;
};

/// Of every plot, pixels.
inline constexpr int plot_width = 680, plot_height = 440;

/// The plot as SVG text.
std::string plot_svg(const Plot& plot);

/// Draws a plot to folder/file.svg. Throws std::runtime_error, naming the file, when it cannot be written.
void draw(const std::filesystem::path& folder, const Plot& plot);

}  // namespace brainshift::pipelines
