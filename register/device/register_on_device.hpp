// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "register/field/brain_zones.hpp"
#include "register/interface/input.hpp"
#include "register/interface/options.hpp"
#include "register/interface/result.hpp"
#include "segmentation/progress/progress.hpp"

namespace brainshift::registration::device {

struct Backend;

/// What is warped.
struct Images {
  const ScalarImage* t1;   ///< or null
  const LabelMap* labels;  ///< or null
};

/// Both fields, measures.not_inverted and the warped images, found on a device: what forward_field(),
/// resampling_field() and warp() give, to rounding. Cubic B-splines are the processor's. Throws
/// solve::device::DeviceFault, and as those.
void register_on(const Backend& backend, const RegisterInput& input, const Images& images,
                 const RegisterOptions& options, const BrainZones& zones, const Progress& progress,
                 Registration& result);

/// That on the GPU where the options ask for it. False: it is to be done on the CPU. Throws as
/// solve::device::where_asked() does.
bool register_if_asked(const RegisterInput& input, const Images& images, const RegisterOptions& options,
                       const BrainZones& zones, const Progress& progress, Registration& result);

}  // namespace brainshift::registration::device
