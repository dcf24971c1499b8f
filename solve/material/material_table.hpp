// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "solve/material/material.hpp"

namespace brainshift::solve {

/// The materials of the labels that occur, as rows of a table.
struct MaterialTable {
  std::vector<Material> material;             ///< one a row
  std::vector<double> density;                ///< g/mm³, one a row
  std::vector<std::vector<PronyTerm>> prony;  ///< one list a row; none when no material relaxes
  std::vector<std::int32_t> row_of_point;     ///< one a point
};

/// label: one a point. Throws std::invalid_argument when a label has no material, or one that check_material refuses.
MaterialTable material_table(const std::map<std::int32_t, Material>& materials, std::span<const std::int32_t> label);

/// ρ in g/mm³.
double density_per_cubic_millimetre(const Material& material);

}  // namespace brainshift::solve
