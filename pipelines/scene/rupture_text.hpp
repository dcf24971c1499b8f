// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solve/interface/cut.hpp"

namespace brainshift::pipelines {

/// "stretch=1.4" or "stress=3000" (Pa), then, where wanted, "distance=2,scatter=0.1,seed=1". Throws
/// std::invalid_argument with what was found and what is allowed.
solve::Rupture rupture_from_text(const std::string& text);

/// "x,y,radius,factor": mm, and the factor of the strength. Throws as rupture_from_text().
solve::WeakSpot weak_spot_from_text(const std::string& text);

}  // namespace brainshift::pipelines
