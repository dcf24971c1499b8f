// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solve/material/material.hpp"

namespace brainshift::solve {

/// Throws std::invalid_argument, one sentence that begins with `name` ("the material of label 2"), unless the constants
/// are what material_options() says (E only where the law has one), the law ogden has 1 to Ogden::capacity terms with
/// α_k ≠ 0 and Σ µ_k > 0, g_i >= 0 with Σ g_i < 1, τ_i > 0, and all of them are finite. Terms of Ogden's under
/// another law are refused, as they would change nothing.
void check_material(const std::string& name, const Material& material);

}  // namespace brainshift::solve
