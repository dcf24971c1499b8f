// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private: numbers in the bytes of a file.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

namespace brainshift {

using ByteView = std::span<const std::uint8_t>;

/// The number at a place in the bytes, which may be in the other byte order. The bytes must reach that far.
template <class T>
T number_at(ByteView bytes, std::size_t place, bool swapped = false) {
  std::array<std::uint8_t, sizeof(T)> raw{};
  std::memcpy(raw.data(), bytes.data() + place, sizeof(T));
  if (swapped) {
    std::reverse(raw.begin(), raw.end());
  }
  return std::bit_cast<T>(raw);
}

}  // namespace brainshift
