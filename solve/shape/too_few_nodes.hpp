// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace brainshift::solve {

/// Thrown where nodes are too few, or lie too badly, for a support, for a point's cover or for the conditions on them.
/// A body that is cut further may come to that.
struct TooFewNodes : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace brainshift::solve
