// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/transient.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "solve/dynamics/motion.hpp"
#include "solve/force/stiffness_bound.hpp"

namespace brainshift::solve {

namespace {

constexpr int look_every = 50;       // steps between looks at the state
constexpr double least_ratio = 0.8;  // of J to that one step before: stiffness is followed only so fast

/// Where all that takes energy is counted: not contact, relaxing materials (the laws' energy is the instantaneous one)
/// or lumped conditions. Else the work is what became of it to a thousandth.
bool balances(const Body& body, const SolveOptions& options) {
  return !body.contact && !body.face_contact && !body.wall_contact && !body.septum_contact && body.prony.empty() &&
         options.imposition == Imposition::exact;
}

/// In a step or two a load is a blow, whose work no step follows.
void refuse_too_short(double duration, double step) {
  constexpr double fewest_steps = 5;
  if (duration < fewest_steps * step) {
    std::ostringstream text;
    text << "the motion is to last " << duration << " s, less than five steps of " << step
         << " s: too short to follow it; give a longer duration, or a longer curve";
    throw std::invalid_argument(text.str());
  }
}

class Transient {
 public:
  Transient(Body body, const Course& course, const SolveOptions& options, double safety)
      : course_(course),
        options_(options),
        motion_(std::move(body), options.snapshot_every),
        laws_(motion_.body.laws),
        safety_(safety),
        most_imbalance_(balances(motion_.body, options) ? 0.05 : std::numeric_limits<double>::infinity()) {
    internal_force(motion_.body.points, motion_.body.laws, motion_.now, motion_.scratch, motion_.force);
    const double critical = critical_now();
    motion_.result.critical_step = critical;
    if (options.time_step > critical) {
      std::ostringstream text;
      text << "the time step of " << options.time_step << " s is above the critical one, " << critical
           << " s: the motion would blow up; leave it out (0) or take a smaller one";
      throw std::invalid_argument(text.str());
    }
    const double step = options.time_step > 0 ? options.time_step : safety_ * critical;
    refuse_too_short(course.curve.duration(), step);
    set_step(step);
    motion_.scratch = ForceScratch(motion_.body.points, laws_);
    motion_.weigh(mass());
  }

  SteppingResult run(const Progress& progress) {
    SteppingResult& result = motion_.result;
    const double end = course_.curve.duration();
    while (result.failure.empty() && !is_at_the_end()) {
      if (result.steps == options_.max_steps) {
        std::ostringstream text;
        text << "stopped after " << result.steps << " steps, at " << motion_.time << " s of " << end
             << " s; allow more steps";
        result.failure = text.str();
        break;
      }
      change_if_due();
      step();
      if (result.steps % look_every == 0 || is_at_the_end() || motion_.squeezed()) {
        look();
        report(progress, motion_.time / end, "step " + std::to_string(result.steps));
      }
    }
    return motion_.finish();
  }

 private:
  const std::vector<double>& mass() const { return motion_.body.mass; }

  bool is_at_the_end() const { return motion_.time >= course_.curve.duration() - step_ / 2; }

  void change_if_due() {
    const BodyChange& change = course_.change;
    const bool looks = change.by_state && motion_.result.steps % look_every == 0;
    if (!change || !(looks || change.is_due(motion_.time))) {
      return;
    }
    const double before = motion_.energy(motion_.body.laws, mass());  // without a step of what the points remember
    if (!motion_.change(change, laws_, motion_.time, true)) {
      return;
    }
    motion_.weigh(mass());
    motion_.lose(before - motion_.energy(motion_.body.laws, mass()));
    follow_stiffness();
  }

  /// Rigorous: strains may be large, and an eigenvalue measured at rest says nothing of them.
  double critical_now() const {
    return critical_step(stiffness_bound(motion_.body.points, motion_.body.laws, motion_.scratch), mass());
  }

  /// Takes a step of at most h that divides the time left; the last increment is scaled so that the velocity stays.
  void set_step(double most) {
    const double left = course_.curve.duration() - motion_.time;
    const double h = left / std::ceil(left / most);
    const double ratio = step_ > 0 ? h / step_ : 1;
    for (std::size_t i = 0; i < motion_.now.size(); ++i) {
      motion_.before[i] = motion_.now[i] - ratio * (motion_.now[i] - motion_.before[i]);
    }
    step_ = h;
    laws_.prony.clear();
    for (const std::vector<PronyTerm>& terms : motion_.body.prony) {
      laws_.prony.emplace_back(terms, h);
    }
  }

  void step() {
    // between the midpoints of the steps before and after the force, where the velocities are
    const double h = step_before_ > 0 ? (step_before_ + step_) / 2 : step_;
    const double ch = options_.damping * h;
    time_of_forces_ = motion_.time;
    const double time = time_of_forces_ + step_;
    motion_.step(laws_, mass(), 2 * h * step_ / (2 + ch), (2 - ch) / (2 + ch), time, course_.curve.at(time));
    step_before_ = step_;
    if (options_.time_step == 0 && !is_at_the_end() && jacobian_range(motion_.scratch).least_ratio < least_ratio) {
      set_step(step_ / 2);
    }
  }

  void look() {
    if (motion_.look(laws_, mass(), most_imbalance_)) {
      motion_.result.history.back().time = time_of_forces_;
      follow_stiffness();
    }
  }

  std::int32_t stiffest_node(const std::vector<double>& bound) const {
    std::int32_t stiffest = 0;
    for (std::size_t a = 0; a < bound.size(); ++a) {
      const auto s = static_cast<std::size_t>(stiffest);
      stiffest = bound[a] * mass()[s] > bound[s] * mass()[a] ? static_cast<std::int32_t>(a) : stiffest;
    }
    return stiffest;
  }

  void follow_stiffness() {
    const std::vector<double> bound = stiffness_bound(motion_.body.points, motion_.body.laws, motion_.scratch);
    const double critical = critical_step(bound, mass());
    const bool given = options_.time_step > 0, softer = 2 * step_ < safety_ * critical;
    if (is_at_the_end() || (step_ <= critical && (given || !softer))) {
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

  const Course& course_;
  const SolveOptions& options_;
  Motion motion_;   // its time is in seconds
  PointLaws laws_;  // with the Prony factors of the step
  double safety_;   // of the critical step
  double most_imbalance_;
  double step_ = 0;  // s
  double step_before_ = 0;
  double time_of_forces_ = 0;  // s; a look sees the state before the step, with the velocities about it
};

}  // namespace

SteppingResult march(Body body, const Course& course, const SolveOptions& options, const Progress& progress) {
  constexpr double safety = 0.9;
  SteppingResult result = Transient(std::move(body), course, options, safety).run(progress);
  if (result.unstable && options.time_step == 0 && !course.change) {
    result = Transient(std::move(result.body), course, options, safety / 2).run(progress);
    if (result.unstable) {
      result.failure = "tried twice, the second time with half the step: " + result.failure;
    }
  }
  return result;
}

}  // namespace brainshift::solve
