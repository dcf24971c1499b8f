// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/options/option.hpp"
#include "solve/material/material.hpp"

namespace brainshift::solve {

/// Name, range, unit and help of each constant of a material. What several of them must satisfy together is
/// check_material's.
const OptionTable<Material>& material_options();

}  // namespace brainshift::solve
