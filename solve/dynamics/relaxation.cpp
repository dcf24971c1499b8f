// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "solve/dynamics/damping_turns.hpp"
#include "solve/dynamics/error_bound.hpp"
#include "solve/dynamics/load_pace.hpp"
#include "solve/dynamics/lowest_eigenvalue.hpp"
#include "solve/dynamics/motion.hpp"
#include "solve/dynamics/quickening.hpp"
#include "solve/dynamics/relaxation_rules.hpp"
#include "solve/dynamics/rest_report.hpp"
#include "solve/dynamics/rigid_part.hpp"
#include "solve/dynamics/slow_parts.hpp"
#include "solve/dynamics/soundness.hpp"
#include "solve/dynamics/span_bound.hpp"
#include "solve/dynamics/stiffening.hpp"
#include "solve/force/largest_eigenvalue.hpp"
#include "solve/force/stiffness_bound.hpp"
#include "solve/shape/nodal_displacement.hpp"

namespace brainshift::solve {

namespace {

constexpr double rate_of_stiff_parts = 0.97;  // slowest of a node in a span, where there are some
constexpr double alpha = relaxation_alpha;

/// By how much swelling stiffens the body in the end: a tissue that has grown by a stretch s has s times its tangent.
double stiffening(const PointLaws& laws) {
  double most = 0;
  for (const double swelling : laws.swelling) {
    most = std::max(most, swelling);
  }
  return std::cbrt(1 + most);
}

class Relaxation {
 public:
  /// cautious: masses from the bound, which holds whatever the state; else from the largest eigenvalue as measured, and
  /// slow motions are made quicker.
  Relaxation(Body body, const Course& course, const SolveOptions& options, bool cautious)
      : window_(course.settled ? settled_window : usual_window),
        course_(course),
        options_(options),
        motion_(std::move(body), options.snapshot_every),
        lowest_(motion_.body.nodes()),
        pace_(steps_of_load(options.load_steps, laws()), course.change.by_state),
        cautious_(cautious) {
    if (course_.settled) {
      mass_ = course_.settled->mass;
      mass_scale_ = course_.settled->mass_scale;
      lowest_.hold(course_.settled->lowest);
      mass_jacobian_ = course_.settled->smallest_jacobian;
      if (course_.settled->of_rigid > 0) {
        rigid_.emplace(motion_.body.positions(motion_.body.original, Eigen::all));
      }
      motion_.weigh(mass_, alpha);
      motion_.start_from(course_.start, mass_jacobian_);
      pace_.skip();
      return;
    }
    internal_force(points(), laws(), motion_.now, motion_.scratch, motion_.force);
    mass_ = stiffness_bound(points(), laws(), motion_.scratch);
    if (!cautious) {
      mass_scale_ = bound_tightness(points(), laws(), mass_, mass_);
    }
    mass_scale_ *= stiffening(laws());
    for (double& m : mass_) {
      m *= mass_margin * mass_scale_;
    }
    motion_.weigh(mass_, alpha);
    if (!course_.start.empty()) {
      start();
      pace_.skip();
      follow_stiffness();
    }
  }

  SteppingResult run(const Progress& progress) {
    SteppingResult& result = motion_.result;
    damp();
    while (result.failure.empty() && result.steps < options_.max_steps) {
      if (result.steps % window_ == 0) {
        change_if_due();
      }
      step();
      if (result.steps % window_ == 0) {
        look();
        damp();
        report_window(progress, result.steps, motion_.time, error_bound_, tolerance(), done_);
        if (motion_.time >= 1 && error_bound_ <= tolerance() && turns_.may_end(result.steps) && no_change_is_left() &&
            ends_soundly()) {
          return finish();
        }
        if (bound_.stands_still(rounding())) {
          error_bound_ = bound_.at_standstill(std::sqrt(critical_beta(smallest_eigenvalue)));
          if (ends_soundly()) {
            if (error_bound_ <= tolerance() && no_change_is_left()) {
              return finish();
            }
            fail_at_standstill();
          }
        }
        if (result.failure.empty() && outlasts(points().precision(), bound_.loaded_steps(), farthest_, tolerance())) {
          result.rounded = true;
          result.failure = outlasts_single(result.steps, error_bound_, tolerance());
        }
      }
    }
    if (result.failure.empty()) {
      result.failure = not_converged(result.steps, error_bound_, tolerance());
      result.fault = restless_node({motion_.now, motion_.before, motion_.next});
      result.fault->explained = true;
    }
    return finish();
  }

 private:
  const PointBlocks& points() const { return motion_.body.points; }
  const PointLaws& laws() const { return motion_.body.laws; }
  std::size_t nodes() const { return motion_.body.nodes(); }

  /// From course_.start, or with its stiff parts as rigid bodies, whichever strains the body less.
  void start() {
    motion_.start_from(course_.start);
    if (motion_.body.stiff_parts.empty()) {
      motion_.find_force(laws());
      return;
    }
    const double strained = motion_.energy(laws(), mass_);
    motion_.start_from(with_rigid_parts(motion_.body, course_.start));
    if (!(motion_.energy(laws(), mass_) <= strained)) {  // it is no number where a point turned inside out
      motion_.start_from(course_.start);
      motion_.find_force(laws());
    }
  }

  /// For the steps up to the next look.
  void damp() {
    const int steps = motion_.result.steps;
    beta_ =
        critical_beta(turns_.eigenvalue(damped_eigenvalue(lowest_.value(), steps, course_.starts_roughly()), steps));
  }

  bool no_change_is_left() const { return !course_.change || course_.change.is_done(); }

  /// Between two windows, so that no difference over steps has a change of the body in it.
  void change_if_due() {
    if (!course_.change ||
        !motion_.change(course_.change, laws(), motion_.time * course_.curve.duration(), calm_ > 0)) {
      return;
    }
    lowest_.begin_anew(nodes());
    internal_force(points(), laws(), motion_.now, motion_.scratch, motion_.force);
    const std::vector<double> bound = stiffness_bound(points(), laws(), motion_.scratch);
    mass_.resize(nodes(), 0.0);
    for (std::size_t a = 0; a < nodes(); ++a) {
      if (mass_margin * mass_scale_ * bound[a] > mass_[a]) {
        mass_[a] = mass_margin * bound[a];  // in full: how tight it is was measured for other supports
      }
    }
    weigh();
    bound_.reset();
    spans_.reset();
    error_bound_ = bound_.value();
    calm_ = 0;
    pace_.wait();
  }

  void step() {
    if (motion_.result.steps % window_ == window_ - 1) {
      lowest_.keep_force(motion_);
    }
    const double time = pace_.go_on(calm_ >= rows_of_rest);
    const double fraction = course_.curve.at(time * course_.curve.duration());
    motion_.step(laws(), mass_, alpha, beta_, time, fraction);
    if (motion_.squeezed()) {
      follow_stiffness();
    }
  }

  bool only_glances() const { return course_.settled && solve::only_glances(motion_.result.steps, options_.max_steps); }

  bool is_sound() { return motion_.look(laws(), mass_, std::numeric_limits<double>::infinity()); }

  bool ends_soundly() {
    if (only_glances() && is_sound()) {
      complete_row();
    }
    return motion_.result.failure.empty();
  }

  /// Once a window: is the state sound, how far is it from rest, how fast does it get there?
  void look() {
    if (!only_glances() && !is_sound()) {
      return;
    }
    const NodalVectors seen = seen_of(motion_.now);
    const double moved = longest_difference(seen, seen_of(motion_.before));
    lowest_.look_at_stiff_parts(motion_, mass_, cautious_);
    farthest_ = std::max(farthest_, largest_component(motion_.now));
    estimate_lowest_eigenvalue(moved);
    add_to_bound(moved);
    spans_.add(seen);
    find_error_bound();
    if (rigid_) {
      turns_.begin_if_due(motion_.result.steps, [&] { return spans_.value() > far_from_rest * tolerance(); });
    }
    if (only_glances()) {
      return;
    }
    complete_row();
    const int windows = motion_.result.steps / window_;
    if (windows % windows_to_stiffness(motion_.time >= 1) == 0) {
      follow_stiffness();
    }
    if (motion_.time >= 1 && !cautious_ && (motion_.rigid_modes || bound_.value() > far_from_rest * tolerance())) {
      quickening_.look(motion_, mass_, beta_, lowest_.value());
    }
  }

  void add_to_bound(double moved) {
    const int begin = motion_.result.steps - window_;
    const double slowest =
        std::max(damped_rate(lowest_.value(), begin, course_.starts_roughly()), turns_.slowest(lowest_.value(), begin));
    bound_.add(moved, std::sqrt(critical_beta(turns_.eigenvalue(lowest_.value(), begin))), motion_.time >= 1,
               rounding(), slowest);
  }

  NodalVectors seen_of(const NodalVectors& parameters) const {
    return course_.bound == BoundOf::parameters ? parameters : displacement_of(motion_.body.nodal_rows, parameters);
  }

  void complete_row() {
    HistoryRow& row = motion_.result.history.back();
    row.residual = residual();
    calm_ = calm_rows(calm_, row.residual);
    row.error_bound = error_bound_;
  }

  /// Not where an update holds it.
  void estimate_lowest_eigenvalue(double moved) {
    const int steps = motion_.result.steps;
    if (!course_.settled || (steps >= settled_steps && !turns_.are_on(steps))) {
      lowest_.estimate(motion_, mass_, alpha, feels_rounding(moved, farthest_, points().precision()),
                       course_.settled.has_value());
    }
  }

  /// By the last steps; once that is small enough, by the last spans, too, which an update may not know yet.
  void find_error_bound() {
    error_bound_ = bound_.value();
    if (error_bound_ <= tolerance()) {
      error_bound_ = spans_.is_known()
                         ? bound_.with_spans(spans_.value(), course_.settled.has_value()) + left_of_rigid_motion()
                         : std::numeric_limits<double>::infinity();
    }
  }

  double left_of_rigid_motion() const {
    if (!rigid_) {
      return 0;
    }
    const int span = window_ * SpanBound::windows_of(window_), now = motion_.result.steps;
    return left_of_rigid(rigid_->longest(spans_.end_of_last(), spans_.begin_of_last()), span,
                         turns_.largest_eigenvalue(lowest_.value(), now - span, now), course_.settled->of_rigid);
  }

  double tolerance() const { return wanted_bound(options_.tolerance, farthest_); }
  double rounding() const { return rounding_of_step(farthest_, points().precision()); }

  void fail_at_standstill() {
    motion_.result.rounded = points().precision() == Precision::single_precision;
    motion_.result.failure =
        stands_still(motion_.result.steps - ErrorBound::standstill, bound_.value(), tolerance(), points().precision());
  }

  /// What still accelerates, over the internal force or the largest at rest so far. Sums over the nodes, not of
  /// squares: what of it can be in a sum of reactions does then not depend on how many nodes there are.
  double residual() {
    const Motion& m = motion_;
    NodalVectors step = m.now;
    for (std::size_t a = 0; a < nodes(); ++a) {
      at(step, a) -= at(m.before, a) + beta_ * (at(m.before, a) - at(m.next, a));
    }
    m.multiply_by_masses(mass_, step);
    const double push = sum_over_nodes(nodes(), [&](std::size_t a) { return at(step, a).norm(); }) / alpha;
    const double force = sum_over_nodes(nodes(), [&](std::size_t a) { return at(m.force, a).norm(); });
    const double most = std::max(force, force_at_rest_);
    force_at_rest_ = push <= residual_at_rest * most ? most : force_at_rest_;
    return most > 0 ? push / most : 0;
  }

  /// Makes the masses anew when a node has become stiffer than they allow for.
  void follow_stiffness() {
    const std::vector<double> bound = stiffness_bound(points(), laws(), motion_.scratch);
    mass_jacobian_ = jacobian_range(motion_.scratch).smallest;
    double stiffer = 0;  // than the masses allow for: times
    for (std::size_t a = 0; a < nodes() && !stiffens_too_much(stiffer); ++a) {
      const double times = mass_scale_ * bound[a] / mass_[a];
      stiffer = times <= stiffer ? stiffer : times;
    }
    if (stiffens_too_much(stiffer)) {
      mark_unstable(inside_out_or_nearly, motion_.time, course_.curve.at(motion_.time * course_.curve.duration()),
                    restless_node({motion_.now, motion_.before, motion_.next}), motion_.result);
    } else if (stiffer > 1) {
      const double lighter = motion_.energy_of_motion(mass_);
      for (std::size_t a = 0; a < nodes(); ++a) {
        mass_[a] = std::max(mass_[a], mass_margin * mass_scale_ * bound[a]);
      }
      motion_.lose(lighter - motion_.energy_of_motion(mass_));
      weigh();
    }
  }

  void weigh() {
    motion_.weigh(mass_, alpha);
    quickening_.weigh(motion_, mass_, beta_);
  }

  SteppingResult finish() {
    motion_.result.error_bound = error_bound_;
    motion_.result.settled = {.mass = std::move(mass_),
                              .mass_scale = mass_scale_,
                              .lowest = lowest_.value(),
                              .smallest_jacobian = mass_jacobian_};
    return motion_.finish();
  }

  const int window_;
  const Course& course_;
  const SolveOptions& options_;
  Motion motion_;  // its time runs from 0 to 1 while the load's curve is run through, then stays
  LowestEigenvalue lowest_;
  std::vector<double> mass_;
  double mass_scale_ = 1;
  double beta_ = 1;           // of the steps since the last look
  double mass_jacobian_ = 1;  // the smallest J of the state that the masses follow
  ErrorBound bound_{window_, margin_of(course_.bound)};
  std::optional<RigidPart> rigid_;
  DampingTurns turns_;
  SpanBound spans_{window_, motion_.body.stiff_parts.empty() ? SpanBound::usual_rate : rate_of_stiff_parts};
  double error_bound_ = std::numeric_limits<double>::infinity();  // at the last look, mm
  LoadPace pace_;
  Quickening quickening_{alpha};
  bool cautious_;
  double done_ = 0;           // reported
  double farthest_ = 0;       // largest |û| on the way, mm
  double force_at_rest_ = 0;  // largest sum of |f_int| of a state at rest, µN
  int calm_ = 0;              // last rows of the history with a residual as at rest
};

SteppingResult relax_once(Body body, const Course& course, const SolveOptions& options, bool cautious,
                          const Progress& progress, const RelaxElsewhere& elsewhere) {
  if (elsewhere) {
    if (std::optional<SteppingResult> result = elsewhere(body, course, options, cautious, progress)) {
      return std::move(*result);
    }
  }
  return Relaxation(std::move(body), course, options, cautious).run(progress);
}

}  // namespace

SteppingResult relax(Body body, const Course& course, const SolveOptions& options, const Progress& progress,
                     const RelaxElsewhere& elsewhere) {
  SteppingResult result = relax_once(std::move(body), course, options, false, progress, elsewhere);
  if (result.unstable && !course.start.empty()) {
    return relax(std::move(result.body),
                 {.curve = course.curve, .start = {}, .change = course.change, .bound = course.bound}, options,
                 progress, elsewhere);
  }
  if (result.unstable && !course.change) {  // a body that was cut does not heal
    result = relax_once(std::move(result.body), course, options, true, progress, elsewhere);
    if (result.unstable) {
      result.failure = "tried twice, the second time with the smallest steps: " + result.failure;
    }
  }
  return result;
}

}  // namespace brainshift::solve
