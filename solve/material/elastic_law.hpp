// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <variant>

#include "solve/material/linear_elastic.hpp"
#include "solve/material/neo_hookean.hpp"
#include "solve/material/ogden.hpp"
#include "solve/material/own_law.hpp"
#include "solve/material/saint_venant_kirchhoff.hpp"

namespace brainshift::solve {

/// What the solver asks of a law: W(F) = W_iso(F) + K/2 θ(F)² with its own dilatation θ, so that the points of a patch
/// can share one θ. The stress is P = isochoric_stress + Kθ dilatation_slope. least_dilatation is θ where J = 0.
template <class OneLaw>
concept IsElasticLaw = requires(const OneLaw& law, const Deformation& d, const Eigen::Matrix3d& gradient) {
  { law.shear_modulus } -> std::convertible_to<double>;
  { law.bulk_modulus } -> std::convertible_to<double>;
  { OneLaw::least_dilatation } -> std::convertible_to<double>;
  { law.isochoric_stress(d) } -> std::convertible_to<Eigen::Matrix3d>;
  { law.isochoric_energy(d) } -> std::convertible_to<double>;
  { law.dilatation(d) } -> std::convertible_to<double>;
  { law.dilatation_slope(d) } -> std::convertible_to<Eigen::Matrix3d>;
  { largest_tangent(law, gradient, 0.0) } -> std::convertible_to<double>;
};

/// One of several laws.
template <IsElasticLaw... Laws>
using OneOf = std::variant<Laws...>;

/// A law ready for the solver. Resolve it (std::visit) once per block of points.
using ElasticLaw = OneOf<NeoHookean, Ogden, SaintVenantKirchhoff, LinearElastic, OwnLaw>;

/// The law of a material that check_material accepts, its instantaneous response where it relaxes.
ElasticLaw elastic_law(const Material& material);

}  // namespace brainshift::solve
