// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "solve/interface/options.hpp"

namespace brainshift::registration {

enum class Interpolation : std::uint8_t { linear, bspline };

/// What each may be stands in option_table.cpp.
struct RegisterOptions {
  double fade = 20.0;  ///< distance outside the brain over which the field goes to zero, mm; it does not fold while
                       ///< displacements away from the brain stay below about 0.7 of it
  Interpolation interpolation = Interpolation::linear;
  double inverse_tolerance = 0.01;            ///< of the inversion at the voxels, mm
  std::int32_t cavity_label = 0;              ///< of the warped labels where a resection has taken tissue out
  double cavity_value = 0;                    ///< the same of the warped image
  solve::Device device = solve::Device::cpu;  ///< of the fields and the warped images, but of B-splines
};

}  // namespace brainshift::registration
