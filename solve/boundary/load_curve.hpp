// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

namespace brainshift::solve {

/// 3-4-5 polynomial s(τ) = 10τ³ − 15τ⁴ + 6τ⁵ on τ in [0, 1], clamped: zero velocity and acceleration at both ends.
inline double smooth_load(double tau) {
  const double t = std::clamp(tau, 0.0, 1.0);
  return t * t * t * (10 + t * (-15 + 6 * t));
}

}  // namespace brainshift::solve
