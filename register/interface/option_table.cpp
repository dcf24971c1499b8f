// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/interface/option_table.hpp"

namespace brainshift::registration {

const OptionTable<RegisterOptions>& register_options() {
  using Options = RegisterOptions;
  static const OptionTable<Options> table = {
      number_option<Options>("fade", &Options::fade,
                             {.low = 0, .high = 1000, .low_allowed = false, .high_allowed = false}, "mm",
                             "outside the brain the field goes to zero over this distance"),
      choice_option<Options>("interpolation", &Options::interpolation,
                             {{"linear", Interpolation::linear}, {"bspline", Interpolation::bspline}},
                             "of the warped image"),
      number_option<Options>("inverse_tolerance", &Options::inverse_tolerance, above_zero, "mm",
                             "of the inversion of the field"),
      number_option<Options>("cavity_label", &Options::cavity_label, {.low = 0, .high = 65535}, "",
                             "in the warped labels where a resection has taken tissue out"),
      number_option<Options>("cavity_value", &Options::cavity_value, any_number, "",
                             "grey value of the warped image there"),
      choice_option<Options>(
          "device", &Options::device,
          {{"cpu", solve::Device::cpu}, {"cuda", solve::Device::cuda}, {"auto", solve::Device::automatic}},
          "what the fields and the warped images are computed on: the processor; an NVIDIA GPU, in a program built "
          "with it; or that where there is one that can, else the processor. A GPU does not do bodies that are cut; "
          "B-splines stay on the processor")};
  return table;
}

void check_options(const RegisterOptions& options) {
  check_table(register_options(), options);
}

}  // namespace brainshift::registration
