// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/geometry/signed_distance.hpp"
#include "solve/ensemble/each.hpp"

namespace brainshift::solve {

/// SignedDistance::value() and ::gradient() at a place (mm) of each member, to rounding.
NumberOfEach<double> distance_of_each(const SignedDistance& distance, const VectorOfEach<double>& place);
VectorOfEach<double> gradient_of_each(const SignedDistance& distance, const VectorOfEach<double>& place);

}  // namespace brainshift::solve
