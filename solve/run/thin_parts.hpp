// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/body/body.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// What of a model is fewer than four spacings of its nodes across: the patch that is moved, or held where nothing is
/// moved, and of each tissue the largest ball in it. points: the integration points and their tissues.
std::vector<ThinPart> thin_parts(const Model& model, const PlacedPoints& points);

}  // namespace brainshift::solve
