// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "segmentation/geometry/on_device.hpp"

namespace brainshift::solve {

// How a point resists its dilatation θ when its patch sees θ̄ of it, per volume:
//   U = K/2 θ̄² + k/2 (θ − θ̄)² + µ ln²(J/J_b) where J < J_b.
// The part that the patch's pressure modes do not see meets a modulus k as soft as the shear, so that it does not lock.
// The last term keeps single points, whose law alone is too weak for that, from turning inside out.

/// k, Pa.
template <class ElasticLaw>
BRAINSHIFT_ON_DEVICE double unprojected_modulus(const ElasticLaw& law) {
  return std::min(law.bulk_modulus, law.shear_modulus);
}

inline constexpr double highest_barrier = 0.5;

/// J_b: no point of a nearly incompressible body comes so low but for want of nodes; 0, no barrier, from K = 3µ down.
template <class ElasticLaw>
BRAINSHIFT_ON_DEVICE double barrier_jacobian(const ElasticLaw& law) {
  return highest_barrier * std::max(0.0, 1 - 3 * law.shear_modulus / law.bulk_modulus);
}

/// ln(J/J_b) below the barrier, else 0; J from θ.
template <class ElasticLaw>
BRAINSHIFT_ON_DEVICE double depth_in_barrier(const ElasticLaw& law, double dilatation) {
  const double jacobian = dilatation - law.least_dilatation;
  if (jacobian >= highest_barrier) {
    return 0;  // as nearly always
  }
  const double barrier = barrier_jacobian(law);
  return jacobian < barrier ? std::log(jacobian / barrier) : 0.0;
}

/// U, Pa.
template <class ElasticLaw>
BRAINSHIFT_ON_DEVICE double point_energy(const ElasticLaw& law, double seen, double dilatation) {
  const double unseen = dilatation - seen, depth = depth_in_barrier(law, dilatation);
  return law.bulk_modulus / 2 * seen * seen + unprojected_modulus(law) / 2 * unseen * unseen +
         law.shear_modulus * depth * depth;
}

/// dU_b/dθ, the barrier's part of the pressure, Pa.
template <class ElasticLaw>
BRAINSHIFT_ON_DEVICE double barrier_pressure(const ElasticLaw& law, double dilatation) {
  const double depth = depth_in_barrier(law, dilatation);
  return depth < 0 ? 2 * law.shear_modulus * depth / (dilatation - law.least_dilatation) : 0.0;
}

/// The pressure of which the patch's variation consists, Kθ̄ + k (θ − θ̄) + dU_b/dθ, Pa.
template <class ElasticLaw>
BRAINSHIFT_ON_DEVICE double point_pressure(const ElasticLaw& law, double seen, double dilatation) {
  return law.bulk_modulus * seen + unprojected_modulus(law) * (dilatation - seen) + barrier_pressure(law, dilatation);
}

/// d²U/dθ² of the point alone, θ̄ held, Pa.
template <class ElasticLaw>
BRAINSHIFT_ON_DEVICE double point_modulus(const ElasticLaw& law, double dilatation) {
  const double jacobian = dilatation - law.least_dilatation, depth = depth_in_barrier(law, dilatation);
  const double barrier = depth < 0 ? 2 * law.shear_modulus * (1 - depth) / (jacobian * jacobian) : 0;
  return unprojected_modulus(law) + barrier;
}

/// The largest tangent of the change of shape, as the patch leaves it to the point under this pressure, Pa.
template <class ElasticLaw>
BRAINSHIFT_ON_DEVICE double shape_tangent(const ElasticLaw& law, const Eigen::Matrix3d& gradient, double pressure,
                                          double dilatation) {
  ElasticLaw alone = law;
  alone.bulk_modulus = point_modulus(law, dilatation);
  const double tangent = largest_tangent(alone, gradient, pressure);
  return std::max(tangent, 2 * law.shear_modulus);
}

/// The lesser, or NaN where one is.
BRAINSHIFT_ON_DEVICE inline double lesser(double a, double b) {
  return a >= b ? b : (b >= a ? a : std::numeric_limits<double>::quiet_NaN());
}

}  // namespace brainshift::solve
