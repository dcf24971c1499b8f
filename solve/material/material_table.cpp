// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/material_table.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "solve/material/check_material.hpp"

namespace brainshift::solve {

MaterialTable material_table(const std::map<std::int32_t, Material>& materials, std::span<const std::int32_t> label) {
  MaterialTable table;
  std::map<std::int32_t, std::int32_t> row_of_label;
  for (const std::int32_t l : label) {
    const auto [row, is_new] = row_of_label.try_emplace(l, static_cast<std::int32_t>(table.material.size()));
    if (is_new) {
      const auto found = materials.find(l);
      if (found == materials.end()) {
        throw std::invalid_argument("tissue label " + std::to_string(l) +
                                    " occurs in the cells but has no material; name one for it");
      }
      check_material("the material of label " + std::to_string(l), found->second);
      table.material.push_back(found->second);
      table.density.push_back(density_per_cubic_millimetre(found->second));
      table.prony.push_back(found->second.prony);
    }
    table.row_of_point.push_back(row->second);
  }
  if (std::all_of(table.prony.begin(), table.prony.end(), [](const auto& terms) { return terms.empty(); })) {
    table.prony.clear();
  }
  return table;
}

double density_per_cubic_millimetre(const Material& material) {
  return 1e-6 * material.density;
}

}  // namespace brainshift::solve
