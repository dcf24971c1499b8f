// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "solve/load/rigid_fit.hpp"
#include "solve/run/measured.hpp"

namespace brainshift::pipelines {

/// mm: a registration that moves by less has come to rest.
inline constexpr double registration_at_rest = 0.01;

struct PatientRegistration {
  solve::RigidMotion motion;
  double open = 0;  ///< mm that the last round would have moved it by
};

/// The rigid transform T between image and tracker that a load with noise tells: what is measured at y lies at T⁻¹ y in
/// the frame of the image. Begins with the best fit of the points and goes on by the motion that fit_measured() finds
/// beside the deformation, until it rests or for six rounds. impose: sets the conditions of the model from a load; at
/// the end they are those of the T that is returned.
PatientRegistration patient_registration(const solve::CraniotomyLoad& load, const solve::SolveOptions& options,
                                         const std::function<void(const solve::CraniotomyLoad&, solve::Model&)>& impose,
                                         solve::Model& model);

/// How far off the registration of a fit may take places of the brain, mm: root of the mean square distance there, by
/// the standard deviations of its shifts and turns.
double registration_deviation(const solve::MeasuredFit& fit, const Points& places);

}  // namespace brainshift::pipelines
