// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "register/interface/options.hpp"
#include "segmentation/options/option.hpp"

namespace brainshift::registration {

/// Name, range, unit and help of each option.
const OptionTable<RegisterOptions>& register_options();

/// Throws std::invalid_argument with a sentence on a value that the table does not allow.
void check_options(const RegisterOptions& options);

}  // namespace brainshift::registration
