// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solve/material/material.hpp"

namespace brainshift::solve {

/// Tissues with constants from the literature, by name; none where the name is unknown.
/// brain, tumour, ventricle: neo-Hookean, those of Wittek et al. 2010 (Prog. Biophys. Mol. Biol. 103:292).
/// brain_ogden: the instantaneous response in Miller & Chinzei 2002 (J. Biomech. 35:483), with ν = 0.49 for their
/// incompressible tissue; brain_viscoelastic adds their relaxation, which leaves 18.5 % of µ.
std::optional<Material> named_material(std::string_view name);

/// The names, in alphabetical order.
std::vector<std::string> material_names();

}  // namespace brainshift::solve
