// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/patient_registration.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace brainshift::pipelines {
namespace {

/// The small motion of a fit as a rigid one.
solve::RigidMotion motion_of(const solve::MeasuredFit& fit) {
  const Eigen::Vector3d turn = fit.motion.tail<3>() / fit.motion_size;
  solve::RigidMotion motion;
  if (turn.norm() > 0) {
    motion.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  }
  motion.translation = fit.motion.head<3>() + fit.motion_centre - motion.rotation * fit.motion_centre;
  return motion;
}

}  // namespace

PatientRegistration patient_registration(const solve::CraniotomyLoad& load, const solve::SolveOptions& options,
                                         const std::function<void(const solve::CraniotomyLoad&, solve::Model&)>& impose,
                                         solve::Model& model) {
  constexpr int most_rounds = 6;
  PatientRegistration found{.motion = solve::fit_rigid(load.positions, load.positions + load.displacement, load.sigma)};
  solve::RigidMotion& whole = found.motion;
  for (int round = 0;; ++round) {
    impose(solve::registered(load, whole), model);
    model.conditions.measured->registration_unknown = true;
    const solve::MeasuredFit fit = solve::fit_measured(solve::thinned_body(model, options.shape), model.conditions);
    found.open = fit.motion.cwiseAbs().maxCoeff();
    if (found.open <= registration_at_rest || round == most_rounds) {
      return found;
    }
    const solve::RigidMotion more = motion_of(fit);
    whole = {whole.rotation * more.rotation, whole.rotation * more.translation + whole.translation};
  }
}

/// About the middle of the points shifts and turns are known independently of each other.
double registration_deviation(const solve::MeasuredFit& fit, const Points& places) {
  const Points arms = (places.rowwise() - fit.motion_centre.transpose()) / fit.motion_size;
  const Eigen::Array3d along = arms.cwiseAbs2().colwise().mean().transpose();
  const Eigen::Array3d from_axis = along.sum() - along;  // squared, of a turn about each axis
  const Eigen::Array3d shifts = fit.motion_deviation.head<3>().cwiseAbs2();
  const Eigen::Array3d turns = fit.motion_deviation.tail<3>().cwiseAbs2();
  return std::sqrt(shifts.sum() + (turns * from_axis).sum());
}

}  // namespace brainshift::pipelines
