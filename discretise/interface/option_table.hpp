// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/interface/options.hpp"
#include "segmentation/options/option.hpp"

namespace brainshift::discretise {

/// Name, range, unit and help of each option.
const OptionTable<DiscretiseOptions>& discretise_options();

/// The same of the refinement towards the craniotomy.
const OptionTable<Refinement>& refinement_options();

/// Throws std::invalid_argument with a sentence on a value that the tables do not allow, and when both spacing and
/// nodes are given.
void check_options(const DiscretiseOptions& options);

}  // namespace brainshift::discretise
