// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/transient.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "solve/cut/dissection.hpp"
#include "solve/dynamics/motion.hpp"
#include "solve/dynamics/stiffness_bound.hpp"

namespace brainshift::solve {

namespace {

constexpr int look_every = 50;       // steps between looks at the state
constexpr double least_ratio = 0.8;  // of J to that one step before: stiffness is followed only so fast

/// Where all that takes energy is counted: not contact, relaxing materials (the laws' energy is the instantaneous one)
/// or lumped conditions. Else the work is what became of it to a thousandth.
bool balances(const System& system, const std::vector<std::vector<PronyTerm>>& prony, const SolveOptions& options) {
  return system.contact == nullptr && system.face_contact == nullptr && prony.empty() &&
         options.imposition == Imposition::exact;
}

class Transient {
 public:
  Transient(const System& system, const std::vector<std::vector<PronyTerm>>& prony, const std::vector<double>& mass,
            const SolveOptions& options, double safety)
      : system_(system),
        laws_(system.laws),
        prony_(prony),
        mass_(mass),
        options_(options),
        motion_(system, PointLaws{{}, {}, system.laws.plane_stress}, options.snapshot_every),
        safety_(safety),
        most_imbalance_(balances(system, prony, options) ? 0.05 : std::numeric_limits<double>::infinity()) {
    internal_force(system_.points, system_.laws, motion_.now, motion_.scratch, motion_.force);
    const double critical = critical_now();
    motion_.result.critical_step = critical;
    if (options.time_step > critical) {
      std::ostringstream text;
      text << "the time step of " << options.time_step << " s is above the critical one, " << critical
           << " s: the motion would blow up; leave it out (0) or take a smaller one";
      throw std::invalid_argument(text.str());
    }
    set_step(options.time_step > 0 ? options.time_step : safety_ * critical);
    motion_.scratch = ForceScratch(system.points, laws_);
    motion_.weigh(mass_);
  }

  SteppingResult run(const Progress& progress) {
    SteppingResult& result = motion_.result;
    const double end = system_.curve.duration();
    while (result.failure.empty() && motion_.time < end - step_ / 2) {
      if (result.steps == options_.max_steps) {
        result.failure = "stopped after " + std::to_string(result.steps) + " steps, at " +
                         std::to_string(motion_.time) + " s of " + std::to_string(end) + " s; allow more steps";
        break;
      }
      cut_if_due();
      step();
      if (result.steps % look_every == 0 || motion_.time >= end - step_ / 2 || motion_.squeezed()) {
        look();
        report(progress, motion_.time / end, "step " + std::to_string(result.steps));
      }
    }
    return motion_.finish();
  }

 private:
  void cut_if_due() {
    Dissection* dissection = system_.dissection;
    const bool looks = dissection != nullptr && dissection->may_tear() && motion_.result.steps % look_every == 0;
    if (dissection == nullptr || !(looks || dissection->is_due(motion_.time))) {
      return;
    }
    const double before = motion_.energy(system_.laws, mass_);  // without a step of what the points remember
    if (!motion_.go_on_cutting(*dissection, laws_, motion_.time, true)) {
      return;
    }
    motion_.weigh(mass_);
    motion_.lose(before - motion_.energy(system_.laws, mass_));
    follow_stiffness();
  }

  /// Rigorous: strains may be large, and an eigenvalue measured at rest says nothing of them.
  double critical_now() const {
    return critical_step(stiffness_bound(system_.points, system_.laws, motion_.scratch), mass_);
  }

  /// Takes a step of at most h that divides the time left; the last increment is scaled so that the velocity stays.
  void set_step(double most) {
    const double left = system_.curve.duration() - motion_.time;
    const double h = left / std::ceil(left / most);
    const double ratio = step_ > 0 ? h / step_ : 1;
    for (std::size_t i = 0; i < motion_.now.size(); ++i) {
      motion_.before[i] = motion_.now[i] - ratio * (motion_.now[i] - motion_.before[i]);
    }
    step_ = h;
    laws_.prony.clear();
    for (const std::vector<PronyTerm>& terms : prony_) {
      laws_.prony.emplace_back(terms, h);
    }
  }

  void step() {
    // between the midpoints of the steps before and after the force, where the velocities are
    const double h = step_before_ > 0 ? (step_before_ + step_) / 2 : step_;
    const double ch = options_.damping * h;
    const double time = motion_.time + step_;
    motion_.step(laws_, mass_, 2 * h * step_ / (2 + ch), (2 - ch) / (2 + ch), time, system_.curve.at(time));
    step_before_ = step_;
    if (options_.time_step == 0 && jacobian_range(motion_.scratch).least_ratio < least_ratio) {
      set_step(step_ / 2);
    }
  }

  void look() {
    if (motion_.look(laws_, mass_, most_imbalance_)) {
      follow_stiffness();
    }
  }

  std::int32_t stiffest_node(const std::vector<double>& bound) const {
    std::int32_t stiffest = 0;
    for (std::size_t a = 0; a < bound.size(); ++a) {
      const auto s = static_cast<std::size_t>(stiffest);
      stiffest = bound[a] * mass_[s] > bound[s] * mass_[a] ? static_cast<std::int32_t>(a) : stiffest;
    }
    return stiffest;
  }

  void follow_stiffness() {
    const std::vector<double> bound = stiffness_bound(system_.points, system_.laws, motion_.scratch);
    const double critical = critical_step(bound, mass_);
    const bool given = options_.time_step > 0, softer = 2 * step_ < safety_ * critical;
    if (motion_.time >= system_.curve.duration() - step_ / 2 || (step_ <= critical && (given || !softer))) {
      return;
    }
    if (given) {
      std::ostringstream text;
      text << "at step " << motion_.result.steps << ", " << motion_.time
           << " s, the body has become so stiff that the critical step is " << critical
           << " s, below the given one; leave it out (0) or take a smaller one; it is stiffest";
      motion_.result.failure = text.str();
      motion_.result.fault = Fault{.node = stiffest_node(bound), .explained = true};
      return;
    }
    set_step(std::min(safety_ * critical, 2 * step_));
  }

  const System& system_;
  PointLaws laws_;  ///< with the Prony factors of the step
  const std::vector<std::vector<PronyTerm>>& prony_;
  const std::vector<double>& mass_;
  const SolveOptions& options_;
  Motion motion_;  // its time is in seconds
  double safety_;  // of the critical step
  double most_imbalance_;
  double step_ = 0;  // s
  double step_before_ = 0;
};

}  // namespace

SteppingResult march(const System& system, const std::vector<std::vector<PronyTerm>>& prony,
                     const std::vector<double>& mass, const SolveOptions& options, const Progress& progress) {
  constexpr double safety = 0.9;
  SteppingResult result = Transient(system, prony, mass, options, safety).run(progress);
  if (result.unstable && options.time_step == 0 && system.dissection == nullptr) {
    result = Transient(system, prony, mass, options, safety / 2).run(progress);
    if (result.unstable) {
      result.failure = "tried twice, the second time with half the step: " + result.failure;
    }
  }
  return result;
}

}  // namespace brainshift::solve
