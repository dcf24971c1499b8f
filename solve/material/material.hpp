// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace brainshift::solve {

/// Neo-Hookean, W = µ/2 (Ī1 − 3) + K/2 (J − 1)², in user's units. More laws join here.
struct Material {
  double youngs_modulus = 3000;  ///< Pa, > 0
  double poisson_ratio = 0.49;   ///< -1 < ν < 0.5
  double density = 1000;         ///< kg/m³, > 0
};

}  // namespace brainshift::solve
