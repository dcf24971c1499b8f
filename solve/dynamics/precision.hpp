// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace brainshift::solve {

/// In which the derivatives of the shape functions are kept while stepping, most of what a step reads. All arithmetic
/// is double in any case.
enum class Precision : std::uint8_t { double_precision, single_precision };

}  // namespace brainshift::solve
