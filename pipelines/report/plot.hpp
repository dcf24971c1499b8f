// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
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

enum class Scale : std::uint8_t { linear, log_y, log_log };

/// A value of y, drawn as a dashed line.
struct DashedLine {
  double y;
  std::string name;
};

/// A shaded part of the x axis.
struct ShadedPart {
  double from, to;
  std::string name;
};

struct Plot {
  std::string file;  ///< without .svg
  std::string title, x_label, y_label;
  std::vector<Series> series;
  Scale scale = Scale::linear;
  std::optional<DashedLine> level = {};
  std::optional<ShadedPart> phase = {};
};

/// The plot as SVG text.
std::string plot_svg(const Plot& plot);

/// Draws a plot to folder/file.svg. Throws std::runtime_error, naming the file, when it cannot be written.
void draw(const std::filesystem::path& folder, const Plot& plot);

}  // namespace brainshift::pipelines
