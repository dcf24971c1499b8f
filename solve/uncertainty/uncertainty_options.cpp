// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/uncertainty/uncertainty_options.hpp"

namespace brainshift::solve {

const OptionTable<UncertaintyOptions>& uncertainty_options() {
  using Options = UncertaintyOptions;
  static const OptionTable<Options> table = {
      number_option<Options>("samples", &Options::samples, {.low = 2, .high = 1000}, "",
                             "solutions with other constants, each on a thinned cloud; the measured points' noise "
                             "needs none"),
      number_option<Options>("shares", &Options::shares, {.low = 1, .high = 1000}, "",
                             "machines that solve the samples, each every so many-th of them: brainshift-bids and "
                             "brainshift-sweep give the runs of their --share-samples this and the next"),
      number_option<Options>("share", &Options::share, {.low = 1, .high = 1000}, "",
                             "which of the shares is solved; at most `shares`"),
      number_option<Options>("seed", &Options::seed, not_negative, "", "of the random numbers"),
      number_option<Options>("stiffness", &Options::stiffness, {.low = 0, .high = 2}, "",
                             "standard deviation of the logarithm of each tissue's stiffness; 0.25: a quarter more or "
                             "less; 0: known"),
      number_option<Options>("poisson", &Options::poisson, {.low = 0, .high = 0.5}, "",
                             "each tissue's Poisson's ratio is uniform within so much of its own, and at most 0.498; "
                             "0: known"),
      number_option<Options>("gravity_angle", &Options::gravity_angle, {.low = 0, .high = 45}, "degrees",
                             "of a scene with gravity: standard deviation of its tilt about each of the two axes "
                             "across it; 0: known"),
      number_option<Options>("fluid_level", &Options::fluid_level, {.low = 0, .high = 100}, "mm",
                             "of a scene with <gravity>: standard deviation of the fluid's level; 0: known")};
  return table;
}

}  // namespace brainshift::solve
