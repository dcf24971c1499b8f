// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace brainshift::solve {

enum class Law : std::uint8_t {
  neo_hookean,
  ogden,
  saint_venant_kirchhoff,
  linear_elastic,
  own,  ///< Material::own
};

struct OgdenTerm {
  double shear_modulus;  ///< µ_k, Pa, of either sign
  double exponent;       ///< α_k, not 0
};

struct PronyTerm {
  double share;  ///< g_i >= 0, of the isochoric stress
  double time;   ///< τ_i > 0, s
};

/// Whether a tissue is a room of fluid, and what becomes of it when the fluid of the body drains to a level.
enum class Room : std::uint8_t {
  none,     ///< solid: above the level it loses its buoyancy
  drained,  ///< it drains with the level: the fluid leaves its wall
  full,     ///< closed: the fluid goes on pressing on its wall as in the image
};

struct OwnElasticity;

/// A tissue as the user describes it. material_options.cpp says what each constant may be, check_material what they
/// must be together; named_materials has some from the literature.
struct Material {
  double youngs_modulus = 3000;  ///< E at rest, Pa; the laws ogden and own say their shear modulus instead
  double poisson_ratio = 0.49;   ///< ν at rest
  double density = 1000;         ///< kg/m³
  double swelling = 0;           ///< share of its volume by which it grows when nothing holds it, under the full load
  Room room = Room::none;        ///< in a body whose fluid drains
  Law law = Law::neo_hookean;
  std::vector<OgdenTerm> ogden = {};              ///< of the law ogden only
  std::vector<PronyTerm> prony = {};              ///< how the isochoric part relaxes; none: it does not
  std::shared_ptr<const OwnElasticity> own = {};  ///< of the law own only
};

/// µ at rest, Pa, before anything relaxes: E / 2(1 + ν), of Ogden's law Σ µ_k.
double shear_modulus(const Material& material);

/// K at rest, Pa: 2µ(1 + ν) / 3(1 − 2ν) = E / 3(1 − 2ν).
double bulk_modulus(const Material& material);

/// Whether a shear modulus is so many times another or more, in any unit.
bool is_times(double times, double shear_modulus, double other);

/// Whether a tissue is so much stiffer that it does not see the nodes of the other: tenfold. Of 150 small random
/// problems 13 have tissues of three to ten times: without, their 95 % errors are 0.75 times as large, as a stiff part
/// of a few nodes, as a tumour, then turns too easily.
bool much_stiffer(double shear_modulus, double other);

/// The largest shear modulus at rest over the least.
double stiffness_contrast(const std::map<std::int32_t, Material>& materials);

/// With all of its stress at the same strain times a factor.
Material stiffened(Material material, double factor);

/// The linear elastic material of the same moduli at rest.
Material linearised(Material material);

/// The elastic material that is left at t = ∞: µ times 1 − Σ g_i, the same K, no Prony terms.
Material long_term(Material material);

}  // namespace brainshift::solve
