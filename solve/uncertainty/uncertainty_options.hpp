// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/options/option.hpp"

namespace brainshift::solve {

/// What nobody knows of a patient, and how far it may be from what the model says. README.md says where the numbers
/// come from.
struct UncertaintyOptions {
  int samples = 16;
  int shares = 1;  ///< machines that solve the samples, of which every so many-th is one's
  int share = 1;   ///< which of them this one is; at most `shares`
  int seed = 1;
  double stiffness = 0.25;   ///< standard deviation of the logarithm of each tissue's stiffness
  double poisson = 0.04;     ///< each tissue's ν is uniform within so much of its value, and below most_poisson
  double gravity_angle = 5;  ///< standard deviation of the tilt of gravity about each axis across it, degrees
  double fluid_level = 5;    ///< standard deviation of the drained fluid's level, mm
};

inline constexpr double most_poisson = 0.498;

const OptionTable<UncertaintyOptions>& uncertainty_options();

}  // namespace brainshift::solve
