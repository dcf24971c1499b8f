// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "segmentation/geometry/surface.hpp"

namespace brainshift::discretise {

/// Throws std::invalid_argument, with one sentence on what is wrong and what to do, unless the surface encloses a body:
/// finite, closed, 2-manifold, free of self-intersection, facing outward, where it has several shells each of them. A
/// shell within another bounds a cavity and faces into it. what: of the surface, for the sentence.
void check_encloses_body(const Surface& surface, const std::string& what = "the brain surface");

}  // namespace brainshift::discretise
