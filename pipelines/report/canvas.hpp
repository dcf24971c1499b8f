// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
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

/// Pixels of a picture. Lines and letters are not drawn into it: Svg lays them over it.
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

/// The picture as a PNG file's bytes.
std::string encode_png(const Canvas& canvas);

/// Bytes as text (RFC 4648, section 4). Throws std::length_error for 1.5 GB or more.
std::string encode_base64(std::string_view bytes);

}  // namespace brainshift::pipelines
