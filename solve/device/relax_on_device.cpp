// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/relax_on_device.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "solve/device/device_body.hpp"
#include "solve/device/device_fault.hpp"
#include "solve/device/read_look.hpp"
#include "solve/dynamics/books.hpp"
#include "solve/dynamics/damping_turns.hpp"
#include "solve/dynamics/error_bound.hpp"
#include "solve/dynamics/load_pace.hpp"
#include "solve/dynamics/quickening.hpp"
#include "solve/dynamics/relaxation.hpp"
#include "solve/dynamics/relaxation_rules.hpp"
#include "solve/dynamics/rest_report.hpp"
#include "solve/dynamics/rigid_part.hpp"
#include "solve/dynamics/soundness.hpp"
#include "solve/dynamics/span_bound.hpp"
#include "solve/dynamics/stiffening.hpp"
#include "solve/force/largest_eigenvalue.hpp"

namespace brainshift::solve::device {

namespace {

static_assert(usual_window <= most_steps && settled_window <= most_steps);

int window_of(const Course& course) {
  return course.settled ? settled_window : usual_window;
}

template <class Scalar>
class Relaxation {
 public:
  /// on: the body, on a device; with settled masses it may have come to rest there before.
  Relaxation(DeviceBody<Scalar>& on, Body& body, const Course& course, const SolveOptions& options, bool cautious)
      : body_(body),
        course_(course),
        options_(options),
        window_(window_of(course)),
        on_(on),
        pace_(steps_of_load(options.load_steps, body.laws), false),
        cautious_(cautious),
        volume_(volumes_of_materials(body)),
        rounding_energy_(rounding_energy(volume_, body.laws) * energy_unit) {
    order_.alpha = relaxation_alpha;
    order_.span = SpanBound::windows_of(window_);
    if (course.settled) {
      if (course.settled->of_rigid > 0) {
        rigid_.emplace(body.positions(body.original, Eigen::all));
      }
      take_over(*course.settled);
      start();
      return;
    }
    find_masses();
    if (!course.start.empty()) {
      start();
      follow_stiffness();
    }
  }

  Relaxed run(const Progress& progress) {
    while (result_.failure.empty() && result_.steps < options_.max_steps) {
      const int steps = std::min(window_, options_.max_steps - result_.steps);
      advance(steps);
      if (steps < window_ || !result_.failure.empty()) {
        break;
      }
      look();
      report_window(progress, result_.steps, time_, error_bound_, tolerance(), done_);
      if (result_.failure.empty() && is_slow()) {
        return finish(true);
      }
      if (time_ >= 1 && error_bound_ <= tolerance() && turns_.may_end(result_.steps) && ends_soundly()) {
        return finish();
      }
      if (result_.failure.empty() && bound_.stands_still(rounding_of_step(farthest_, precision()))) {
        error_bound_ = bound_.at_standstill(std::sqrt(critical_beta(smallest_eigenvalue)));
        if (ends_soundly()) {
          if (error_bound_ <= tolerance()) {
            return finish();
          }
          result_.rounded = precision() == Precision::single_precision;
          result_.failure =
              stands_still(result_.steps - ErrorBound::standstill, error_bound_, tolerance(), precision());
        }
      }
      if (result_.failure.empty() && outlasts(precision(), bound_.loaded_steps(), farthest_, tolerance())) {
        result_.rounded = true;
        result_.failure = outlasts_single(result_.steps, error_bound_, tolerance());
      }
    }
    if (result_.failure.empty()) {
      result_.failure = not_converged(result_.steps, error_bound_, tolerance());
      result_.fault = where(false);
      result_.fault->explained = true;
    }
    return finish();
  }

 private:
  Precision precision() const { return body_.points.precision(); }
  double tolerance() const { return wanted_bound(options_.tolerance, farthest_); }
  double* displacement(int steps_on) const { return on_.view().displacement[(order_.first + steps_on) % 3]; }

  void find_masses() {
    order_.iterations = tightness_iterations;
    order_.mode_size = small_mode;
    if (!cautious_) {
      on_.perform(Task::follow, order_);
      on_.write(rough_mode(on_.nodes()), on_.view().mode_of_body);
      on_.perform(Task::measure_tightness, order_);
      order_.mass_scale = std::min(1.0, tightness_margin * on_.record().eigenvalue);
    }
    order_.mass_margin = mass_margin;
    on_.perform(Task::follow, order_);
    weigh();
  }

  void take_over(const Settled& settled) {
    order_.mass_margin = mass_margin;
    order_.mass_scale = settled.mass_scale;
    lowest_ = settled.lowest;
    mass_jacobian_ = squeezed_to_ = settled.smallest_jacobian;
    on_.forget_steps();
    if (on_.weighed() != settled.mass) {
      on_.write(settled.mass, on_.view().stiffer_mass);
      weigh();
    }
  }

  /// As Motion::start_from().
  void start() {
    on_.write(course_.start, displacement(1));
    order_.fraction[0] = 1;
    on_.perform(Task::hold, order_);
    for (double* to : {displacement(0), displacement(2), on_.kept_displacement}) {
      on_.backend().copy(to, displacement(1), 4 * on_.nodes() * sizeof(double));
    }
    fraction_ = fraction_before_ = time_ = 1;
    books_.start();
    pace_.skip();
  }

  void weigh() {
    on_.note_weighed({});
    on_.perform(Task::weigh, order_);
    if (on_.record().singular != 0) {
      body_.essential.factorise(on_.masses(), order_.alpha);  // which says where
      throw DeviceFault("the prescribed displacements nearly repeat each other; take device cpu");
    }
  }

  /// Makes the masses anew when a node has become stiffer than they allow for.
  void follow_stiffness() {
    on_.perform(Task::follow, order_);
    const FollowSums sums = on_.record().follow;
    mass_jacobian_ = -sums.of[FollowSums::minus_jacobian];
    if (stiffens_too_much(sums.of[FollowSums::stiffer])) {
      mark_unstable(inside_out_or_nearly, time_, fraction_, where(false), result_);
    } else if (sums.of[FollowSums::stiffer] > 1) {
      books_.dissipated +=
          (1 + order_.beta) / (4 * order_.alpha) * (sums.of[FollowSums::inertia] - sums.of[FollowSums::inertia_then]);
      weigh();
    }
  }

  bool only_glances(int steps) const { return course_.settled && solve::only_glances(steps, options_.max_steps); }

  /// So many steps of a window, and the look at its end.
  void advance(int steps) {
    const double beta_before = order_.beta;
    const double eigenvalue = damped_eigenvalue(lowest_, result_.steps, course_.starts_roughly());
    order_.beta = critical_beta(turns_.eigenvalue(eigenvalue, result_.steps));
    order_.glance = only_glances(result_.steps + steps);
    for (int done = 0; done < steps; done += record_.steps) {
      const LoadPace pace_before = pace_;
      double time[most_steps];
      order_.steps = steps - done;
      order_.halt_below = squeezed_share * squeezed_to_;
      order_.fraction[0] = fraction_;
      for (int s = 0; s < order_.steps; ++s) {
        time[s] = pace_.go_on(false);
        order_.fraction[s + 1] = course_.curve.at(time[s] * course_.curve.duration());
      }
      on_.perform(Task::step, order_);
      on_.perform(Task::look, after(order_.steps));
      record_ = on_.record();
      keep_books(done == 0 ? beta_before : order_.beta);
      fraction_before_ = order_.fraction[record_.steps - 1];
      fraction_ = order_.fraction[record_.steps];
      time_ = time[record_.steps - 1];
      const bool rewind = record_.steps < order_.steps;
      order_ = after(record_.steps);
      result_.steps += record_.steps;
      if (rewind) {
        pace_ = pace_before;
        for (int s = 0; s < record_.steps; ++s) {
          pace_.go_on(false);
        }
      }
      if (record_.halted != 0) {
        squeezed_to_ = record_.jacobian[record_.steps - 1];
        follow_stiffness();
        if (!result_.failure.empty()) {
          return;
        }
        if (done + record_.steps == steps) {
          on_.perform(Task::look, order_);
          record_.look = on_.record().look;
        }
      }
    }
    ++order_.states;
  }

  /// As Motion::add_energies() after each of the steps taken; beta_before: of the step before them.
  void keep_books(double beta_before) {
    const auto& of = record_.steps_taken.of;
    const double alpha = order_.alpha, beta = order_.beta;
    const auto lost = [&](double two_steps, double push_work) {
      return (1 - beta) / (4 * alpha) * two_steps - push_work / alpha;
    };
    books_.add(Books::StepsTaken{.moved_on = fraction_ - fraction_before_,
                                 .rate_first = of[StepSums::rate_first] / alpha,
                                 .rate_last = of[StepSums::rate_last] / alpha,
                                 .reaction_work = of[StepSums::reaction_work] / alpha,
                                 .force_work = of[StepSums::force_work],
                                 .force_work_last = of[StepSums::force_work_last],
                                 .lost = lost(of[StepSums::two_steps], of[StepSums::push_work]),
                                 .lost_last = lost(of[StepSums::two_steps_last], of[StepSums::push_work_last])});
    books_.dissipated += (beta_before - beta) / (4 * alpha) * of[StepSums::first_before];
  }

  Order after(int steps) const {
    Order order = order_;
    order.first = (order_.first + steps) % 3;
    order.parity = (order_.parity + steps) % 2;
    return order;
  }

  double moved() const { return std::sqrt(record_.look.of[LookSums::longest_step]); }

  /// As relax() has it: where the last look was a glance, with another at the points.
  bool ends_soundly() {
    if (result_.failure.empty() && order_.glance) {
      order_.glance = false;
      --order_.states;
      on_.perform(Task::look, order_);
      ++order_.states;
      record_.look = on_.record().look;
      if (is_sound(moved())) {
        complete_row();
      }
    }
    return result_.failure.empty();
  }

  /// As Motion::look() and what relax() reads off a window.
  void look() {
    const auto& of = record_.look.of;
    if (!order_.glance && !is_sound(moved())) {
      return;
    }
    farthest_ = std::max(farthest_, of[LookSums::farthest]);
    estimate_lowest_eigenvalue(moved());
    add_to_bound();
    find_error_bound();
    if (rigid_) {
      turns_.begin_if_due(result_.steps, [&] {
        return spans_are_known() && left_by_spans(record_.look) > far_from_rest * tolerance();
      });
    }
    if (order_.glance) {
      return;
    }
    complete_row();
    if (result_.steps / window_ % windows_to_stiffness(time_ >= 1) == 0) {
      follow_stiffness();
    }
  }

  void add_to_bound() {
    const int begin = result_.steps - window_;
    const double slowest =
        std::max(damped_rate(lowest_, begin, course_.starts_roughly()), turns_.slowest(lowest_, begin));
    bound_.add(moved(), std::sqrt(critical_beta(turns_.eigenvalue(lowest_, begin))), time_ >= 1,
               rounding_of_step(farthest_, precision()), slowest);
  }

  bool spans_are_known() const { return order_.states > 2 * order_.span; }

  void find_error_bound() {
    error_bound_ = bound_.value();
    if (error_bound_ <= tolerance()) {
      error_bound_ = spans_are_known() ? bound_.with_spans(left_by_spans(record_.look), window_ == settled_window) +
                                             left_of_rigid_motion()
                                       : std::numeric_limits<double>::infinity();
    }
  }

  /// As relax() has it, of the states that the looks left on the device: asked for near the end alone.
  double left_of_rigid_motion() const {
    if (!rigid_) {
      return 0;
    }
    const auto state = [&](int looks_on) {
      const auto place = static_cast<std::size_t>((order_.states - 1 + looks_on) % (2 * order_.span + 1));
      return on_.read(on_.view().span_state + 4 * on_.nodes() * place);
    };
    const int span = window_ * order_.span;
    return left_of_rigid(rigid_->longest(state(0), state(1 + order_.span)), span,
                         turns_.largest_eigenvalue(lowest_, result_.steps - span, result_.steps),
                         course_.settled->of_rigid);
  }

  bool is_sound(double moved) {
    const auto& of = record_.look.of;
    const PointState state = point_state(record_.look, volume_);
    const double two = of[LookSums::inertia_two], alpha = order_.alpha, beta = order_.beta;
    const double kinetic = kinetic_energy(alpha, beta, two, of[LookSums::inertia_now], of[LookSums::inertia_before]);
    books_.look(state.strain_energy, kinetic);
    constexpr double newton = 1e-6;  // µN to N
    HistoryRow row{.step = result_.steps, .time = time_};
    row.external_work = books_.external_work * energy_unit;
    row.strain_energy = state.strain_energy * energy_unit;
    row.kinetic_energy = kinetic * energy_unit;
    row.dissipated_energy = books_.dissipated * energy_unit;
    row.reaction =
        newton / alpha * Eigen::Vector3d(of[LookSums::reaction_x], of[LookSums::reaction_y], of[LookSums::reaction_z]);
    books_.largest_work = std::max(books_.largest_work, std::abs(row.external_work));
    const double motion = two * (1 + beta) / (16 * alpha) * energy_unit;
    const std::string fault = unsound(state, moved);
    const bool lively = motion > most_motion * std::max(books_.largest_work, rounding_energy_);
    if (!fault.empty() || lively) {
      mark_unstable(fault.empty() ? unbalanced(row) : fault, time_, fraction_, where(!fault.empty()), result_);
      return false;
    }
    result_.state = state;
    result_.fraction = fraction_;
    squeezed_to_ = state.smallest_jacobian;
    on_.backend().copy(on_.kept_displacement, displacement(0), 4 * on_.nodes() * sizeof(double));
    on_.backend().copy(on_.kept_multipliers, on_.multipliers(1 - order_.parity), on_.conditions() * sizeof(double));
    result_.history.push_back(row);
    return true;
  }

  /// Where it went wrong, with the host's means; at_point: at an integration point if there is one.
  Fault where(bool at_point) {
    const NodalVectors now = on_.read(displacement(0)), before = on_.read(displacement(2)),
                       next = on_.read(displacement(1));
    if (at_point) {
      ForceScratch scratch(body_.points, body_.laws);
      NodalVectors force(now.size());
      internal_force(body_.points, body_.laws, before, scratch, force);
      if (!(jacobian_range(scratch).smallest > 0)) {
        return broken_point(body_.points, scratch, {now, before, next});
      }
    }
    return restless_node({now, before, next});
  }

  /// A_0 from the last increments, and where these feel rounding from those of the last window, too.
  void estimate_lowest_eigenvalue(double moved) {
    if (course_.settled && (result_.steps < settled_steps || turns_.are_on(result_.steps))) {
      return;
    }
    const auto& of = record_.look.of;
    double estimate =
        lowest_eigenvalue(record_.look, looked_under_load_ && feels_rounding(moved, farthest_, precision()));
    looked_under_load_ = time_ >= 1 && !course_.settled;
    if (estimate > 0) {
      const double springs = fraction_ == fraction_before_ ? of[LookSums::spring_work] / order_.alpha : 0;
      estimate =
          bounded_eigenvalue(estimate + (springs > 0 ? rayleigh_quotient(springs, of[LookSums::inertia_now]) : 0));
      lowest_ = course_.settled ? std::min(lowest_, estimate) : estimate;
    }
  }

  void complete_row() {
    const auto& of = record_.look.of;
    const double most = std::max(of[LookSums::force], force_at_rest_);
    force_at_rest_ = of[LookSums::push] <= residual_at_rest * most ? most : force_at_rest_;
    result_.history.back().residual = most > 0 ? of[LookSums::push] / most : 0;
    result_.history.back().error_bound = error_bound_;
  }

  /// relax() would make its rigid motions quicker. Not at the first sign: that ends the device's part.
  bool is_slow() {
    constexpr int slow_steps = 100;
    const bool steps_left = result_.steps + window_ <= options_.max_steps;
    const bool slow = steps_left && time_ >= 1 && !cautious_ && std::isfinite(bound_.value()) &&
                      bound_.value() > far_from_rest * tolerance() && Quickening::wanted(lowest_);
    slow_steps_ = slow ? slow_steps_ + window_ : 0;
    return slow_steps_ >= slow_steps;
  }

  Relaxed finish(bool slow = false) {
    result_.error_bound = error_bound_;
    result_.parameters = on_.read(on_.kept_displacement);
    result_.settled = {
        .mass = on_.masses(), .mass_scale = order_.mass_scale, .lowest = lowest_, .smallest_jacobian = mass_jacobian_};
    on_.note_weighed(result_.settled.mass);
    std::vector<double> multipliers(on_.conditions());
    on_.backend().from_device(multipliers.data(), on_.kept_multipliers, multipliers.size() * sizeof(double));
    result_.reactions = body_.essential.reactions(order_.alpha, on_.nodes(), multipliers);
    result_.body = std::move(body_);
    return {std::move(result_), slow};
  }

  Body& body_;
  const Course& course_;
  const SolveOptions& options_;
  const int window_;
  DeviceBody<Scalar>& on_;
  Order order_;
  Record record_;
  LoadPace pace_;
  ErrorBound bound_{window_};
  std::optional<RigidPart> rigid_;
  DampingTurns turns_;
  Books books_;
  SteppingResult result_;
  bool cautious_;
  int slow_steps_ = 0;
  std::vector<double> volume_;                                    // of each material, mm³
  double rounding_energy_;                                        // mJ
  double lowest_ = 1e-4;                                          // A_0: a guess until there are increments
  double error_bound_ = std::numeric_limits<double>::infinity();  // at the last look, mm
  double time_ = 0, fraction_ = 0, fraction_before_ = 0;
  double squeezed_to_ = 1;    // J
  double mass_jacobian_ = 1;  // J of the state that the masses follow
  double farthest_ = 0;       // largest |û| on the way, mm
  double force_at_rest_ = 0;  // largest sum of |f_int| of a state at rest, µN
  double done_ = 0;           // reported
  bool looked_under_load_ = false;
};

}  // namespace

template <class Scalar>
Relaxed relax(DeviceBody<Scalar>& on, Body& body, const Course& course, const SolveOptions& options, bool cautious,
              const Progress& progress) {
  return Relaxation<Scalar>(on, body, course, options, cautious).run(progress);
}

template Relaxed relax(DeviceBody<float>& on, Body& body, const Course& course, const SolveOptions& options,
                       bool cautious, const Progress& progress);
template Relaxed relax(DeviceBody<double>& on, Body& body, const Course& course, const SolveOptions& options,
                       bool cautious, const Progress& progress);

Relaxed relax(const Backend& backend, Body& body, const Course& course, const SolveOptions& options, bool cautious,
              const Progress& progress) {
  const auto with = [&]<class Scalar>(Scalar) {
    DeviceBody<Scalar> on(backend, body, window_of(course));
    return relax(on, body, course, options, cautious, progress);
  };
  return body.points.precision() == Precision::single_precision ? with(float{}) : with(double{});
}

}  // namespace brainshift::solve::device
