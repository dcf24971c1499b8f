// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/completed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solve/dynamics/relaxation.hpp"

namespace brainshift::solve {

namespace {

/// Derivatives rounded to single precision err by 1e-7 of a strain, which K answers, and a stiff part hands on to a
/// soft one: the bound of the error no longer holds beyond these (measured: tests/extremes, precision).
constexpr double most_bulk_in_single = 400;         // K / µ of a material
constexpr double most_contrast_in_single = 1000;    // largest over least µ
constexpr double most_of_both_in_single = 4e4;      // largest K over least µ
constexpr double most_of_both_under_forces = 1000;  // the same where a stiff part may weigh on soft tissue
constexpr double farthest_in_single = 0.5;          // what is imposed, over the size of the body: half turns
constexpr double finest_in_single = 1e-5;           // error that may be left, over the size of the body

/// The largest component that is prescribed at any time, mm.
double largest_imposed(const Model& model) {
  double imposed = 0;
  for (const double u : model.conditions.displacement.reshaped()) {
    imposed = std::max(imposed, std::isnan(u) ? 0 : std::abs(u));
  }
  return model.curve.largest() * imposed;
}

/// The error that relaxation may leave open, mm, as far as the load says it beforehand.
double error_wanted(double imposed, double tolerance) {
  return imposed > 0 ? std::min(tolerance, open_part * imposed) : tolerance;
}

/// Whether a stiff part may weigh on a soft one. Not asked of fluid that drains: with 60 % of a phantom above it, whose
/// ventricles make largest K over least µ 33,000, single ends 0.001 mm off double at a bound of 0.009 mm.
bool bears_forces(const Model& model) {
  return !model.gravity.isZero() || model.conditions.force.rows() > 0 || model.body_force;
}

bool single_serves(const Model& model, double tolerance) {
  double bulk = 0, stiffest = 0, softest = std::numeric_limits<double>::infinity();
  for (const auto& [label, material] : model.materials) {
    bulk = std::max(bulk, bulk_modulus(material) / shear_modulus(material));
    stiffest = std::max(stiffest, bulk_modulus(material));
    softest = std::min(softest, shear_modulus(material));
  }
  const Points& x = model.cloud.positions;
  const double size = (x.colwise().maxCoeff() - x.colwise().minCoeff()).maxCoeff();
  const double imposed = largest_imposed(model);
  return bulk <= most_bulk_in_single && stiffness_contrast(model.materials) <= most_contrast_in_single &&
         stiffest <= (bears_forces(model) ? most_of_both_under_forces : most_of_both_in_single) * softest &&
         imposed <= farthest_in_single * size && error_wanted(imposed, tolerance) >= finest_in_single * size;
}

}  // namespace

SolveOptions completed(SolveOptions options, const Model& model) {
  options.shape.planar = model.plane != Plane::none;
  if (!single_serves(model, options.tolerance)) {
    options.precision = Precision::double_precision;
  }
  return options;
}

}  // namespace brainshift::solve
