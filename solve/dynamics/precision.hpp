// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace brainshift::solve {

/// Of the derivatives of the shape functions while stepping, most of what a step reads, and of the sums over pairs of
/// points and nodes. Stresses are double in any case.
enum class Precision : std::uint8_t { double_precision, single_precision };

}  // namespace brainshift::solve
