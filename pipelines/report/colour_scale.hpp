// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "pipelines/report/canvas.hpp"

namespace brainshift::pipelines {

enum class ColourMap : std::uint8_t {
  sequential,  ///< dark violet to yellow, lightness grows evenly: readable in grey and by the colour-blind
  diverging,   ///< blue, black, orange: differences, zero is black
};

/// Numbers as colours.
struct ColourScale {
  ColourMap map = ColourMap::sequential;
  double low = 0;
  double high = 1;
  std::string title;  ///< with the unit

  Colour colour_of(double value) const;
};

/// The least of 1, 2, 2.5, 5 · 10^k that is not below the value; 1 when the value is not positive.
double round_up(double value);

/// An upright colour bar with numbers to its right and its title above; takes 90 pixels of width.
void draw_colour_bar(Canvas& canvas, const ColourScale& scale, int x, int y, int height, const Colour& text);

}  // namespace brainshift::pipelines
