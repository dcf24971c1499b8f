// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace brainshift::solve {

/// How many times stiffer a node may at once be than its mass allows for; more is of a state that no body comes to.
inline constexpr double most_stiffening = 1e6;

inline constexpr const char* inside_out_or_nearly = "points have turned inside out or nearly";

/// Of `times` stiffer: also where that is no number, as of points that have turned inside out.
inline bool stiffens_too_much(double times) {
  return !(times < most_stiffening);
}

}  // namespace brainshift::solve
