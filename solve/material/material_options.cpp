// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/material_options.hpp"

namespace brainshift::solve {
namespace {

// A thousand times diamond, and a thousand times the densest metal: far beyond, numbers overflow.
constexpr Range stiffest{.low = 0, .high = 1e15, .low_allowed = false};
constexpr Range heaviest{.low = 0, .high = 1e8, .low_allowed = false};

Option<Material> poisson_ratio_option() {
  auto option = number_option<Material>("poisson_ratio", &Material::poisson_ratio,
                                        {.low = -1, .high = 0.5, .low_allowed = false, .high_allowed = false}, "",
                                        "how little the volume changes");
  option.allowed += ", which is incompressible; for brain 0.49";
  return option;
}

}  // namespace

const OptionTable<Material>& material_options() {
  static const OptionTable<Material> table = {
      choice_option<Material>("law", &Material::law,
                              {{"neo_hookean", Law::neo_hookean},
                               {"ogden", Law::ogden},
                               {"saint_venant_kirchhoff", Law::saint_venant_kirchhoff},
                               {"linear_elastic", Law::linear_elastic}},
                              "material law"),
      number_option<Material>("youngs_modulus", &Material::youngs_modulus, stiffest, "Pa",
                              "stiffness at rest; the law ogden takes its terms instead"),
      poisson_ratio_option(),
      number_option<Material>("density", &Material::density, heaviest, "kg/m3", "mass"),
      pairs_option<Material>("ogden", &Material::ogden, "pairs mu,alpha separated by semicolons, or nothing",
                             "Pa and 1", "terms of the law ogden, as 842,-4.7"),
      pairs_option<Material>("prony", &Material::prony, "pairs share,time separated by semicolons, or nothing",
                             "1 and s", "how the isochoric stress relaxes, as 0.450,0.50; 0.365,50"),
      number_option<Material>("swelling", &Material::swelling, {.low = -0.9, .high = 10}, "",
                              "share of its volume by which the tissue grows (oedema) or shrinks (below 0) when "
                              "nothing holds it; it comes with the load's curve"),
      choice_option<Material>("room", &Material::room,
                              {{"none", Room::none}, {"drained", Room::drained}, {"full", Room::full}},
                              "of a scene with <gravity>: whether the tissue is a room of fluid that drains with the "
                              "level, or stays full and goes on pressing on its wall; none: it is solid")};
  return table;
}

}  // namespace brainshift::solve
