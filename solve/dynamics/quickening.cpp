// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/quickening.hpp"

#include <algorithm>
#include <functional>

#include "solve/dynamics/slow_parts.hpp"

namespace brainshift::solve {

namespace {

/// sum ← a + b.
void add(const NodalVectors& a, const NodalVectors& b, NodalVectors& sum) {
  sum.resize(a.size());
  std::transform(a.begin(), a.end(), b.begin(), sum.begin(), std::plus<>());
}

}  // namespace

void Quickening::look(Motion& motion, std::span<const double> mass, double beta, double lowest) {
  constexpr int seldom = 10;  // windows
  if (!motion.rigid_modes) {
    const Body& body = motion.body;
    const NodeLists parts = free_stiff_parts(body);
    if (!wanted(lowest) && parts.empty()) {
      return;
    }
    motion.rigid_modes.emplace(body.positions(body.original, Eigen::all), body.essential.nodes(), parts);
    windows_ = 0;
  }
  if (windows_++ % seldom == 0) {
    measure_tissue(motion);
  }
  weigh(motion, mass, beta);
}

void Quickening::weigh(Motion& motion, std::span<const double> mass, double beta) {
  if (motion.rigid_modes) {
    motion.quicken(mass, tissue_, contact(motion, mass, beta));
  }
}

void Quickening::measure_tissue(Motion& motion) {
  constexpr double small = 1e-3;  // rotation: straight enough, and far above what single precision rounds
  resistance_.resize(motion.now.size());
  const auto resist = [&](const NodalVectors& moved) -> const NodalVectors& {
    add(motion.now, moved, state_);
    internal_force(motion.body.points, motion.body.laws, state_, motion.scratch, resistance_);
    return resistance_;
  };
  tissue_ = motion.rigid_modes->stiffness(resist, small * motion.rigid_modes->radius());
}

/// Contact resists like a spring that takes back in one step what is beyond. What touched in the last step still does a
/// tiny motion away from where that step was before contact.
RigidModes::Matrix Quickening::contact(Motion& motion, std::span<const double> mass, double beta) {
  if (!motion.body.may_touch()) {
    return RigidModes::Matrix::Zero(motion.rigid_modes->motions(), motion.rigid_modes->motions());
  }
  constexpr double tiny = 1e-6;  // mm
  NodalVectors untouched = motion.before;
  for (std::size_t a = 0; a < mass.size(); ++a) {
    at(untouched, a) += beta * (at(motion.before, a) - at(motion.next, a)) - alpha_ / mass[a] * at(motion.force, a);
  }
  const auto resist = [&](const NodalVectors& moved) -> const NodalVectors& {
    add(untouched, moved, state_);
    resistance_ = state_;
    motion.body.touch(resistance_);
    for (std::size_t a = 0; a < mass.size(); ++a) {
      at(resistance_, a) = mass[a] / alpha_ * (at(state_, a) - at(resistance_, a));
    }
    return resistance_;
  };
  return motion.rigid_modes->stiffness(resist, tiny);
}

}  // namespace brainshift::solve
