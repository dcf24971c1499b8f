// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "register/field/brain_zones.hpp"
#include "register/interface/result.hpp"
#include "segmentation/image/image.hpp"
#include "solve/interface/solution.hpp"

namespace brainshift::registration {

/// The measures of two fields that go there and back: not those of the inversion, of cavities and of landmarks.
RegisterMeasures measure_fields(const VectorImage& forward, const VectorImage& resampling, const ScalarImage& jacobian,
                                const std::vector<Zone>& zone, const Solution& solution);

}  // namespace brainshift::registration
