// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipelines/runner/warnings.hpp"
#include "register/interface/result.hpp"

namespace brainshift::pipelines {

/// Of a field that folds, that departs from the solution or is made up far from all nodes, and of landmarks outside the
/// image or in what was taken out.
Warnings warnings_of(const registration::RegisterMeasures& measures);

}  // namespace brainshift::pipelines
