// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace brainshift::pipelines {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue

namespace colour {
inline constexpr Colour white = {255, 255, 255};
inline constexpr Colour black = {0, 0, 0};
inline constexpr Colour ink = {32, 36, 42};
}  // namespace colour

/// A picture, drawn by the processor: it needs neither a display nor a graphics driver.
/// Positions are in pixels from the upper left corner; a pixel's centre lies at its index + 0.5.
struct Canvas {
  Canvas(int width_, int height_, Colour background);

  int width;
  int height;
  std::vector<Colour> pixels;  ///< row by row from the top

  Colour& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  const Colour& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// share 0: a, 1: b.
Colour blend(const Colour& a, const Colour& b, double share);

/// Lays a colour over a pixel; outside the canvas nothing happens.
void blend_pixel(Canvas& canvas, int x, int y, const Colour& over, double share);

/// A straight stroke with round ends and soft edges, clipped at the border.
void draw_line(Canvas& canvas, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
               const Colour& stroke);

void draw_arrow(Canvas& canvas, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
                const Colour& stroke);

void fill_rectangle(Canvas& canvas, int x, int y, int width, int height, const Colour& fill);

/// Copies a picture into another, its upper left corner at (x, y).
void paste(Canvas& canvas, const Canvas& picture, int x, int y);

/// Where the given position lies in the text.
enum class Anchor : std::uint8_t { left, centre, right };

struct TextStyle {
  int size = 16;  ///< height of the letters' box, pixels
  Colour fill = colour::ink;
  Anchor anchor = Anchor::left;
  bool bold = false;
  bool halo = false;  ///< a dark seam, for text on a picture
};

/// One line of text, centred vertically on the position.
void draw_text(Canvas& canvas, const Eigen::Vector2d& position, const std::string& text, const TextStyle& style);

/// The picture as a PNG file's bytes.
std::string encode_png(const Canvas& canvas);

std::string encode_base64(std::string_view bytes);

}  // namespace brainshift::pipelines
