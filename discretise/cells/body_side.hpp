// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/body/scanlines.hpp"
#include "discretise/sizing/tissue_lookup.hpp"

namespace brainshift::discretise {

/// The body on one side of the wall that a resection will leave, or all of it. No cell has a part on both sides.
struct BodySide {
  Scanlines body;
  TissueLookup tissue;
};

}  // namespace brainshift::discretise
