// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace brainshift::registration {

/// A number whose bytes are in the other order.
template <class Number>
Number with_bytes_swapped(Number value) {
  auto bytes = std::bit_cast<std::array<std::byte, sizeof(Number)>>(value);
  std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<Number>(bytes);
}

/// Turns numbers to this machine's order of bytes, or back.
template <class Numbers>
void swap_if(bool swapped, Numbers& values) {
  for (std::size_t i = 0; swapped && i < values.size(); ++i) {
    values[i] = with_bytes_swapped(values[i]);
  }
}

}  // namespace brainshift::registration
