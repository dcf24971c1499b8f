// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/lowest_eigenvalue.hpp"

#include <algorithm>

#include "solve/dynamics/relaxation_rules.hpp"
#include "solve/dynamics/slow_parts.hpp"

namespace brainshift::solve {

namespace {

/// Rayleigh's quotient of the change from (place, force) to `before` and its force; not above 0: it does not tell.
double eigenvalue_since(const Motion& m, std::span<const double> mass, const NodalVectors& place,
                        const NodalVectors& force) {
  const double stiffness = sum_over_nodes(m.body.nodes(), [&](std::size_t a) {
    return (at(m.before, a) - at(place, a)).dot(at(m.force, a) - at(force, a));
  });
  return rayleigh_quotient(stiffness, m.inertia(mass, m.before, place));
}

/// The share of conditions that give way in A_0; 0 where there are none.
double spring_stiffness(const Motion& m, std::span<const double> mass, double alpha) {
  const double work = m.body.essential.spring_work(m.before, m.now) / alpha;
  return work > 0 ? work / m.inertia(mass, m.now, m.before) : 0;
}

}  // namespace

void LowestEigenvalue::begin_anew(std::size_t nodes) {
  force_before_.assign(4 * nodes, 0.0);
  place_at_look_.clear();
}

void LowestEigenvalue::look_at_stiff_parts(Motion& motion, std::span<const double> mass, bool cautious) {
  constexpr int seldom = 200;                   // steps
  constexpr double surroundings_follow = 0.25;  // which a part that moves alone strains more
  if (motion.time < 1 || motion.body.stiff_parts.empty() || motion.result.steps < next_look_at_parts_) {
    return;
  }
  next_look_at_parts_ = motion.result.steps + seldom;
  const NodeLists parts = cautious ? motion.body.stiff_parts : parts_without_modes(motion.body);
  const double slowest = slowest_rigid_motion(motion.body, parts, mass, motion.now, motion.scratch);
  of_parts_ = slowest > 0 ? std::max(surroundings_follow * slowest, smallest_eigenvalue) : of_parts_;
}

void LowestEigenvalue::estimate(const Motion& motion, std::span<const double> mass, double alpha, bool rounding_is_felt,
                                bool held) {
  double estimate = eigenvalue_since(motion, mass, motion.next, force_before_);
  if (!place_at_look_.empty() && rounding_is_felt) {
    estimate = std::min(estimate, eigenvalue_since(motion, mass, place_at_look_, force_at_look_));
  }
  if (motion.time >= 1 && !held) {  // windows of an update are too short to average rounding out
    place_at_look_ = motion.before;
    force_at_look_ = motion.force;
  }
  if (estimate > 0) {
    estimate = bounded_eigenvalue(estimate + spring_stiffness(motion, mass, alpha));
    // More damping makes steps shorter, but not what is left: near the end that would pass for rest.
    value_ = held ? std::min(value_, estimate) : estimate;
  }
  value_ = std::min(value_, of_parts_);
}

}  // namespace brainshift::solve
