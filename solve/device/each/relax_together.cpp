// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/each/relax_together.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <string>

#include "solve/device/device_fault.hpp"
#include "solve/device/each/device_ensemble.hpp"
#include "solve/dynamics/load_pace.hpp"
#include "solve/dynamics/soundness.hpp"
#include "solve/dynamics/span_bound.hpp"
#include "solve/dynamics/stiffening.hpp"
#include "solve/ensemble/way.hpp"
#include "solve/force/largest_eigenvalue.hpp"

namespace brainshift::solve::device {

namespace {

static_assert(usual_window <= most_steps);

Members bit_of(std::size_t member) {
  return Members{1} << member;
}

/// What a look says of the last two spans, once there are two.
class SpansSeen {
 public:
  SpansSeen(const LookOfEach& look, std::size_t m, bool known)
      : value_(known ? std::max(
                           look.of[LookOfEach::span_of_nodes][m],
                           SpanBound::of_all(look.of[LookOfEach::span_longest][m], look.of[LookOfEach::span_product][m],
                                             look.of[LookOfEach::span_squares][m]))
                     : 0.0) {}

  double value() const { return value_; }
  void reset() { value_ = 0; }

 private:
  double value_;
};

/// The energy that a member may have, by the work that was done on it: as EachMotion keeps it.
struct WorkOnMember {
  double rounding_energy = 0;
  double external = 0, largest = 0;
  double rate = 0, of_forces = 0;  // of the last step

  void add(double fraction_change, double rate_now, double of_forces_now) {
    external += fraction_change * (rate_now + rate) / 2 + of_forces;
    rate = rate_now;
    of_forces = of_forces_now;
  }
  double over(double kinetic) {
    largest = std::max(largest, std::abs(external));
    return kinetic / (most_motion * std::max(largest, rounding_energy));
  }
};

/// How the load of a member comes.
struct LoadOnMember {
  LoadPace pace;
  double time = 0, fraction = 0, fraction_before = 0;
  bool looked_at = false;  // under the whole load

  explicit LoadOnMember(int load_steps) : pace(load_steps, false) {}
  bool whole() const { return time >= 1; }
};

/// The loads that are stepped together.
template <class Scalar>
class Ensemble {
 public:
  Ensemble(DeviceEnsemble<Scalar>& on, const Body& body, std::span<const Member> loads, const LoadCurve& curve,
           const SolveOptions& options)
      : on_(on),
        body_(body),
        curve_(curve),
        options_(options),
        ways_(loads.size()),
        work_(loads.size()),
        ended_at_(loads.size()),
        results_(loads.size()) {
    const std::vector<double> volume = volumes_of_materials(body);
    for (std::size_t m = 0; m < loads.size(); ++m) {
      work_[m].rounding_energy = rounding_energy(volume, loads[m].laws);
      load_.emplace_back(steps_of_load(options.load_steps, loads[m].laws));
      active_ |= bit_of(m);
    }
    on_.load(loads);
    order_.alpha = relaxation_alpha;
    find_first_masses();
    if (!loads.front().start.empty()) {
      start(loads);
    }
  }

  std::vector<MemberResult> run(const Progress& progress) {
    while (active_ != 0 && steps_ < options_.max_steps) {
      const int steps = std::min(usual_window, options_.max_steps - steps_);
      advance(steps);
      if (steps == usual_window) {
        look();
        report(progress, 0.5 * load_.front().time, "step " + std::to_string(steps_) + " of an ensemble");
      }
    }
    for_each(active_, [&](std::size_t m) { end(m, MemberResult::End::not_converged); });
    read_parameters();
    return std::move(results_);
  }

 private:
  Precision precision() const { return body_.points.precision(); }

  template <class Use>
  static void for_each(Members who, const Use& use) {
    for (; who != 0; who &= who - 1) {
      use(static_cast<std::size_t>(std::countr_zero(who)));
    }
  }

  void perform(TaskOfEach task, Members who, OrderOfEach order) {
    order.who = who;
    on_.perform(task, order);
  }

  double* displacement(int steps_on) const { return on_.view().displacement[(order_.first + steps_on) % 3]; }

  void find_first_masses() {
    std::fill_n(order_.mass_scale, most_members, 1.0);
    perform(TaskOfEach::follow, active_, order_);
    std::vector<double> modes(on_.values());
    const NodalVectors mode = rough_mode(on_.nodes());
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const std::size_t component = i / most_members;
      modes[i] = mode[component / 3 * 4 + component % 3];
    }
    on_.write(modes, on_.view().mode_of_body);
    order_.iterations = tightness_iterations;
    order_.mode_size = small_mode;
    perform(TaskOfEach::measure_tightness, active_, order_);
    on_.read(record_);
    for_each(active_, [&](std::size_t m) {
      order_.mass_scale[m] = ways_[m].mass_scale = std::min(1.0, tightness_margin * record_.eigenvalue[m]);
    });
    order_.mass_margin = mass_margin;
    perform(TaskOfEach::follow, active_, order_);
    weigh(active_);
  }

  /// As EachMotion::start_from().
  void start(std::span<const Member> loads) {
    on_.write(on_.starts(loads), displacement(1));
    on_.set_fractions(std::vector((most_steps + 1) * most_members, 1.0));
    perform(TaskOfEach::hold, active_, order_);
    for (double* to : {displacement(0), displacement(2)}) {
      on_.backend().copy(to, displacement(1), on_.values() * sizeof(double));
    }
    perform(TaskOfEach::measure_energy, active_, order_);
    on_.read(record_);
    for_each(active_, [&](std::size_t m) {
      work_[m].external = record_.energy[m];
      load_[m].time = load_[m].fraction = load_[m].fraction_before = 1;
      load_[m].pace.skip();
      ways_[m].started = true;
    });
    follow_stiffness(active_);
  }

  void weigh(Members who) {
    perform(TaskOfEach::weigh, who, order_);
    on_.read(record_);
    for_each(who, [&](std::size_t m) {
      if (record_.singular[m] != 0) {
        throw_singular(m);
      }
    });
  }

  [[noreturn]] void throw_singular(std::size_t m) const {
    const std::vector<double> of_each = on_.read(on_.view().mass, on_.nodes() * most_members);
    std::vector<double> mass(on_.nodes());
    for (std::size_t a = 0; a < mass.size(); ++a) {
      mass[a] = of_each[a * most_members + m];
    }
    EssentialConditions essential = body_.essential;
    essential.factorise(mass, relaxation_alpha);  // which says where
    throw DeviceFault("the prescribed displacements nearly repeat each other; take device cpu");
  }

  /// Makes the masses of those members anew of which a node has become stiffer than they allow for.
  void follow_stiffness(Members asked) {
    if (asked == 0) {
      return;
    }
    perform(TaskOfEach::follow, asked, order_);
    on_.read(record_);
    Members stiffer = 0;
    for_each(asked, [&](std::size_t m) {
      if (stiffens_too_much(record_.stiffer[m])) {
        end(m, MemberResult::End::left);
      } else if (record_.stiffer[m] > 1) {
        stiffer |= bit_of(m);
      }
    });
    if (stiffer != 0) {
      weigh(stiffer);
    }
  }

  OrderOfEach after(int steps) const {
    OrderOfEach order = order_;
    order.first = (order_.first + steps) % 3;
    order.parity = (order_.parity + steps) % 2;
    return order;
  }

  /// So many steps of a window, and the look at its end. A member that is squeezed halts all.
  void advance(int steps) {
    for_each(active_, [&](std::size_t m) { order_.beta[m] = ways_[m].beta(); });
    for (int done = 0; done < steps && active_ != 0;) {
      done += advance_until_halt(steps - done);
      const Members halted = record_.halted;
      if (halted == 0) {
        continue;
      }
      follow_stiffness(halted);
      if (done == steps) {
        perform(TaskOfEach::look, active_, order_);
        on_.read(record_);
      }
    }
    ++order_.states;
  }

  /// Returns the steps.
  int advance_until_halt(int steps) {
    set_fractions(steps);
    order_.steps = steps;
    for_each(active_, [&](std::size_t m) { order_.halt_below[m] = squeezed_share * ways_[m].squeezed_to; });
    perform(TaskOfEach::step, active_, order_);
    perform(TaskOfEach::look, active_, after(steps));
    on_.read(record_);
    const int done = record_.steps;
    for_each(active_, [&](std::size_t m) {
      for (int s = 1; s <= done; ++s) {
        load_[m].time = load_[m].pace.go_on(false);
        keep_books(m, record_.step[s]);
      }
      smallest_jacobian_[m] = last_jacobian(m);
    });
    for_each(record_.halted, [&](std::size_t m) { ways_[m].squeezed_to = last_jacobian(m); });
    steps_ += done;
    order_ = after(done);
    return done;
  }

  void set_fractions(int steps) {
    std::vector<double> fractions((most_steps + 1) * most_members, 0.0);
    for_each(active_, [&](std::size_t m) {
      LoadPace pace = load_[m].pace;
      fractions[m] = load_[m].fraction;
      for (int s = 1; s <= steps; ++s) {
        fractions[static_cast<std::size_t>(s) * most_members + m] = fraction_at(pace.go_on(false));
      }
    });
    on_.set_fractions(fractions);
  }
  double fraction_at(double time) const { return curve_.at(time * curve_.duration()); }

  /// Of the last step's force.
  double last_jacobian(std::size_t m) const {
    return -record_.step[record_.steps - 1].of[StepOfEach::minus_jacobian][m];
  }

  /// Of a step to the member's time.
  void keep_books(std::size_t m, const StepOfEach& sums) {
    LoadOnMember& load = load_[m];
    const double fraction = fraction_at(load.time);
    work_[m].add(load.fraction - load.fraction_before, sums.of[StepOfEach::multiplier_work][m] / relaxation_alpha,
                 (load.fraction + fraction) / 2 * sums.of[StepOfEach::force_work][m]);
    load.fraction_before = load.fraction;
    load.fraction = fraction;
  }

  /// Once a window: as solve::relax_together() does it.
  void look() {
    const LookOfEach of = record_.look;
    Members asked = 0;
    for_each(active_, [&](std::size_t m) {
      const double moved = std::sqrt(of.of[LookOfEach::longest_step][m]);
      const double kinetic = of.of[LookOfEach::inertia_two][m] * (1 + order_.beta[m]) / (16 * relaxation_alpha);
      const SeenOfMember seen{.moved = moved,
                              .farthest = of.of[LookOfEach::farthest][m],
                              .smallest_jacobian = smallest_jacobian_[m],
                              .lowest = lowest_eigenvalue(of, m, moved),
                              .motion_over_work = work_[m].over(kinetic)};
      const bool loaded = load_[m].whole();
      load_[m].looked_at = loaded;
      if (!ways_[m].look(seen, loaded, precision())) {
        end(m, MemberResult::End::left);
      } else if (steps_ / usual_window % windows_to_stiffness(loaded) == 0) {
        asked |= bit_of(m);
      }
    });
    follow_stiffness(asked);
    for_each(active_, [&](std::size_t m) {
      SpansSeen spans(of, m, order_.states > 2);
      const auto how = ways_[m].end(options_.tolerance, load_[m].whole(), false, precision(), spans);
      spans_[m] = spans.value();
      if (how) {
        end(m, *how);
      }
    });
  }

  /// A_0 from the last increments, and where these feel rounding from those of the last window, too; not above 0: they
  /// do not tell.
  double lowest_eigenvalue(const LookOfEach& look, std::size_t m, double moved) const {
    const auto of = [&](int k) { return look.of[k][m]; };
    double lowest = rayleigh_quotient(of(LookOfEach::stiffness), of(LookOfEach::inertia_before));
    if (load_[m].looked_at && feels_rounding(moved, ways_[m].farthest_with(of(LookOfEach::farthest)), precision())) {
      lowest = std::min(lowest, rayleigh_quotient(of(LookOfEach::window_stiffness), of(LookOfEach::window_inertia)));
    }
    const bool is_steady = load_[m].fraction == load_[m].fraction_before;
    const double springs = is_steady ? of(LookOfEach::spring_work) / relaxation_alpha : 0;
    return lowest > 0 ? lowest + (springs > 0 ? rayleigh_quotient(springs, of(LookOfEach::inertia_now)) : 0) : 0;
  }

  void end(std::size_t m, MemberResult::End how) {
    results_[m] = {.end = how, .parameters = {}, .error_bound = ways_[m].bound.with_spans(spans_[m]), .steps = steps_};
    ended_at_[m] = order_.first;
    active_ &= ~bit_of(m);
  }

  /// A member that has ended is left where it was.
  void read_parameters() {
    for (int first = 0; first < 3; ++first) {
      std::vector<double> of_each;
      for (std::size_t m = 0; m < results_.size(); ++m) {
        if (results_[m].end != MemberResult::End::rest || ended_at_[m] != first) {
          continue;
        }
        if (of_each.empty()) {
          of_each = on_.read(on_.view().displacement[first], on_.values());
        }
        results_[m].parameters = vectors_of_member(of_each, m);
      }
    }
  }

  DeviceEnsemble<Scalar>& on_;
  const Body& body_;
  const LoadCurve& curve_;
  const SolveOptions& options_;
  OrderOfEach order_;
  RecordOfEach record_{};
  std::vector<Way> ways_;
  std::vector<WorkOnMember> work_;
  std::vector<LoadOnMember> load_;
  std::vector<int> ended_at_;  // order_.first then
  Members active_ = 0;
  std::vector<MemberResult> results_;
  std::array<double, most_members> smallest_jacobian_{};  // of the last step's force
  std::array<double, most_members> spans_{};              // SpansSeen of the last look, mm
  int steps_ = 0;
};

template <class Scalar>
std::vector<MemberResult> relax_all(const Backend& backend, const Body& body, std::span<const Member> loads,
                                    const LoadCurve& curve, const SolveOptions& options, const Progress& progress) {
  const bool with_forces =
      std::any_of(loads.begin(), loads.end(), [](const Member& load) { return !load.external.empty(); });
  DeviceEnsemble<Scalar> on(backend, body, with_forces);
  std::vector<MemberResult> results;
  while (results.size() < loads.size()) {
    const std::span<const Member> some =
        loads.subspan(results.size(), std::min<std::size_t>(most_members, loads.size() - results.size()));
    const auto all = static_cast<double>(loads.size()), before = static_cast<double>(results.size());
    const Progress of_these = part_of(progress, before / all, (before + static_cast<double>(some.size())) / all);
    const auto ensemble = std::make_unique<Ensemble<Scalar>>(on, body, some, curve, options);  // large for a stack
    for (MemberResult& result : ensemble->run(of_these)) {
      results.push_back(std::move(result));
    }
  }
  return results;
}

}  // namespace

std::vector<MemberResult> relax_together(const Backend& backend, const Body& body, std::span<const Member> loads,
                                         const LoadCurve& curve, const SolveOptions& options,
                                         const Progress& progress) {
  return body.points.precision() == Precision::single_precision
             ? relax_all<float>(backend, body, loads, curve, options, progress)
             : relax_all<double>(backend, body, loads, curve, options, progress);
}

}  // namespace brainshift::solve::device
