// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace brainshift {

/// Deflate, of .gz and zlib, makes nothing smaller than by this factor (zlib's technical notes).
constexpr std::uintmax_t most_deflated = 1032;

}  // namespace brainshift
