// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/named_materials.hpp"

#include <functional>
#include <map>

namespace brainshift::solve {

namespace {

const std::map<std::string, Material, std::less<>>& table() {
  static const std::map<std::string, Material, std::less<>> materials = {
      {"brain", {.youngs_modulus = 3000, .poisson_ratio = 0.49}},
      {"brain_ogden", {.law = Law::ogden, .ogden = {{842, -4.7}}}},
      {"brain_viscoelastic", {.law = Law::ogden, .ogden = {{842, -4.7}}, .prony = {{0.450, 0.50}, {0.365, 50}}}},
      {"tumour", {.youngs_modulus = 9000, .poisson_ratio = 0.49}},
      {"ventricle", {.youngs_modulus = 10, .poisson_ratio = 0.1, .room = Room::drained}},
  };
  return materials;
}

}  // namespace

std::optional<Material> named_material(std::string_view name) {
  const auto found = table().find(name);
  return found == table().end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const auto& [name, material] : table()) {
    names.push_back(name);
  }
  return names;
}

}  // namespace brainshift::solve
