// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "pipelines/report/svg.hpp"

namespace brainshift::pipelines {

enum class ColourMap : std::uint8_t {
  sequential,  ///< pale grey to yellow, orange and dark red: zero is pale; readable in grey and by the colour-blind
  diverging,   ///< blue, black, orange: differences, zero is black
};

/// Numbers as colours.
struct ColourScale {
  ColourMap map = ColourMap::sequential;
  double low = 0;
  double high = 1;
  std::string title = {};  ///< with the unit

  /// Evenly spaced from low to high; colours between them pass into each other.
  std::span<const Colour> nodes() const;
  Colour colour_of(double value) const;
};

/// The least of 1, 1.6, 2, 3, 4, 6, 8 times 10^k (a quarter of each is short) that is not below the value; 1 when the
/// value is not positive.
double round_up(double value);

/// An upright colour bar with numbers to its right and its title above; takes 90 pixels of width.
void draw_colour_bar(Svg& picture, const ColourScale& scale, const Eigen::Vector2d& corner, double height,
                     const Colour& text);

}  // namespace brainshift::pipelines
