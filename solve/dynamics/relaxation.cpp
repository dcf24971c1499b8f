// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "solve/cut/dissection.hpp"
#include "solve/dynamics/largest_eigenvalue.hpp"
#include "solve/dynamics/motion.hpp"
#include "solve/dynamics/stiffness_bound.hpp"

namespace brainshift::solve {

namespace {

constexpr int window = 20;           // steps between looks at the state
constexpr int recent_windows = 4;    // that the error bound looks back on
constexpr double open_part = 0.02;   // of the largest displacement: the error that may be left, whatever the tolerance
constexpr double mass_margin = 1.1;  // stiffness may grow by this before the masses are made anew

/// α of all steps. It stays the same: nodes in contact rest where a step's push and their way back cancel, which moves
/// with α. Stable up to 2(1 + β) for A_m = 1; the best, 4/(1 + √A_0)², would save an eighth of the steps.
constexpr double alpha = 3;

/// β that makes the lowest mode decay fastest, by √β a step: its critical damping.
double critical_beta(double lowest_eigenvalue) {
  const double root = 1 - std::sqrt(alpha * lowest_eigenvalue);
  return root * root;
}

class Relaxation {
 public:
  /// cautious: masses from the bound, which holds whatever the state; else from the largest eigenvalue as measured.
  Relaxation(const System& system, const SolveOptions& options, bool cautious)
      : system_(system),
        options_(options),
        nodes_(system.points.nodes()),
        motion_(system, system.laws, options.snapshot_every),
        force_before_(motion_.force),
        load_steps_(std::max(options.load_steps, 1)) {
    internal_force(system_.points, system_.laws, motion_.now, motion_.scratch, motion_.force);
    mass_ = stiffness_bound(system_.points, system_.laws, motion_.scratch);
    if (!cautious) {
      mass_scale_ = bound_tightness(system_.points, system_.laws, mass_, mass_);
    }
    for (double& m : mass_) {
      m *= mass_margin * mass_scale_;
    }
    motion_.weigh(mass_);
    if (system_.start != nullptr) {
      motion_.start_from(*system_.start, system_.laws);
      load_step_ = load_steps_;
      follow_stiffness();
    }
  }

  SteppingResult run(const Progress& progress) {
    SteppingResult& result = motion_.result;
    while (result.failure.empty() && result.steps < options_.max_steps) {
      if (result.steps % window == 0) {
        cut_if_due();
      }
      step();
      if (result.steps % window == 0) {
        look();
        report_progress(progress);
        if (motion_.time >= 1 && bound_ <= tolerance() && all_cut()) {
          return finish();
        }
      }
    }
    if (result.failure.empty()) {
      std::ostringstream text;
      text << "not converged after " << result.steps << " steps: the error bound is " << bound_ << " mm, wanted "
           << tolerance() << " mm; allow more steps or a larger tolerance; it moves most";
      result.failure = text.str();
      result.fault = restless_node({motion_.now, motion_.before, motion_.next});
      result.fault->explained = true;
    }
    return finish();
  }

 private:
  bool all_cut() const { return system_.dissection == nullptr || system_.dissection->is_done(); }

  bool may_tear() const { return system_.dissection != nullptr && system_.dissection->may_tear(); }

  /// A tear is much faster than the load, which waits for it.
  bool rests() const { return calm_ >= rows_of_rest; }

  /// Between two windows, so that no difference over steps has a cut in it.
  void cut_if_due() {
    if (system_.dissection == nullptr ||
        !motion_.go_on_cutting(*system_.dissection, system_.laws, motion_.time * system_.curve.duration(), calm_ > 0)) {
      return;
    }
    nodes_ = system_.points.nodes();
    force_before_.assign(4 * nodes_, 0.0);
    internal_force(system_.points, system_.laws, motion_.now, motion_.scratch, motion_.force);
    const std::vector<double> bound = stiffness_bound(system_.points, system_.laws, motion_.scratch);
    mass_.resize(nodes_, 0.0);
    for (std::size_t a = 0; a < nodes_; ++a) {
      if (mass_margin * mass_scale_ * bound[a] > mass_[a]) {
        mass_[a] = mass_margin * bound[a];  // in full: how tight it is was measured for other supports
      }
    }
    motion_.weigh(mass_);
    moved_.clear();
    rates_.clear();
    bounds_.clear();
    bound_ = std::numeric_limits<double>::infinity();
    calm_ = 0;
    slowest_ = slowest_in_tearing;
  }

  void step() {
    if (motion_.result.steps % window == window - 1) {
      std::swap(motion_.force, force_before_);
    }
    load_further();
    const double time = std::min(1.0, load_step_ / load_steps_);
    const double fraction = system_.curve.at(time * system_.curve.duration());
    motion_.step(system_.laws, mass_, alpha, critical_beta(lowest_), time, fraction);
    if (motion_.squeezed()) {
      follow_stiffness();
    }
  }

  /// A body that may tear is loaded as slowly as it comes to rest. The speed changes evenly in proportion: a jump of it
  /// would be one of the inertia in the reactions.
  void load_further() {
    if (may_tear()) {
      constexpr double faster = 1.01, slower = 0.99;
      load_speed_ *= rests() ? faster : slower;
      load_speed_ = std::min(std::max(load_speed_, slowest_ * load_steps_), 1.0);
    } else {
      load_speed_ = 1;
    }
    load_step_ += load_speed_;
  }

  /// Once a window: is the state sound, how far is it from rest, how fast does it get there?
  void look() {
    if (!motion_.look(system_.laws, mass_, std::numeric_limits<double>::infinity())) {
      return;
    }
    estimate_lowest_eigenvalue();
    estimate_error(largest_difference(motion_.now, motion_.before));
    farthest_ = std::max(farthest_, largest_component(motion_.now));
    HistoryRow& row = motion_.result.history.back();
    row.residual = residual();
    calm_ = calm_rows(calm_, row.residual);
    row.error_bound = bound_;
    const int windows = motion_.result.steps / window;
    if (windows % (motion_.time < 1 ? 3 : 10) == 0) {
      follow_stiffness();
    }
  }

  /// A_0 from the last increments: `before` and the force are one step after `next` and the force before.
  void estimate_lowest_eigenvalue() {
    const Motion& m = motion_;
    const double stiffness = sum_over_nodes(nodes_, [&](std::size_t a) {
      return (at(m.before, a) - at(m.next, a)).dot(at(m.force, a) - at(force_before_, a));
    });
    const double inertia = sum_over_nodes(
        nodes_, [&](std::size_t a) { return mass_[a] * (at(m.before, a) - at(m.next, a)).squaredNorm(); });
    if (inertia > 0 && stiffness > 0) {
      lowest_ = std::clamp(stiffness / inertia, smallest_eigenvalue, largest_eigenvalue_of_beta);
    }
  }

  /// ρ/(1 − ρ) |û⁺ − û|∞, ρ the slower of the measured rate and of the rate √β that the damping stands for. A passing
  /// low, as when the body swings through a turning point, is no rest: the largest of the last windows counts, for the
  /// rate and for the bound.
  void estimate_error(double moved) {
    moved_.push_back(moved);
    rates_.push_back(std::sqrt(critical_beta(lowest_)));
    bounds_.push_back(std::numeric_limits<double>::infinity());
    if (motion_.time >= 1 && moved_.size() > recent_windows) {
      const double earlier = *(moved_.end() - 1 - recent_windows);
      const double measured = moved > 0 ? std::pow(moved / earlier, 1.0 / (recent_windows * window)) : 0.0;
      const double rate = std::max(measured, *std::max_element(rates_.end() - recent_windows, rates_.end()));
      bounds_.back() = rate < 1 ? rate / (1 - rate) * moved : bounds_.back();
      bound_ = *std::max_element(bounds_.end() - recent_windows, bounds_.end());
    }
  }

  /// The bound that is wanted, mm: of a small load's answer not more than a small part is left open.
  double tolerance() const {
    return farthest_ > 0 ? std::min(options_.tolerance, open_part * farthest_) : options_.tolerance;
  }

  /// What still accelerates, over the internal force or the largest at rest so far. Sums over the nodes, not of
  /// squares: what of it can be in a sum of reactions does then not depend on how many nodes there are.
  double residual() {
    const Motion& m = motion_;
    const double beta = critical_beta(lowest_);
    const double push = sum_over_nodes(nodes_, [&](std::size_t a) {
      return mass_[a] / alpha * (at(m.now, a) - at(m.before, a) - beta * (at(m.before, a) - at(m.next, a))).norm();
    });
    const double force = sum_over_nodes(nodes_, [&](std::size_t a) { return at(m.force, a).norm(); });
    const double most = std::max(force, force_at_rest_);
    force_at_rest_ = push <= residual_at_rest * most ? most : force_at_rest_;
    return most > 0 ? push / most : 0;
  }

  /// Makes the masses anew when a node has become stiffer than they allow for.
  void follow_stiffness() {
    const std::vector<double> bound = stiffness_bound(system_.points, system_.laws, motion_.scratch);
    bool stiffer = false;
    for (std::size_t a = 0; a < nodes_; ++a) {
      stiffer = stiffer || mass_scale_ * bound[a] > mass_[a];
    }
    if (stiffer) {
      for (std::size_t a = 0; a < nodes_; ++a) {
        mass_[a] = std::max(mass_[a], mass_margin * mass_scale_ * bound[a]);
      }
      motion_.weigh(mass_);
    }
  }

  void report_progress(const Progress& progress) const {
    std::ostringstream text;
    text << "step " << motion_.result.steps;
    double done = 0.3 * motion_.time;
    if (std::isfinite(bound_)) {
      text << ", error bound " << bound_ << " mm";
      const double decades = std::log10(std::max(bound_ / tolerance(), 1.0));
      done = 1 - 0.7 * std::min(decades / 3, 1.0);
    }
    report(progress, done, text.str());
  }

  SteppingResult finish() {
    motion_.result.error_bound = bound_;
    SteppingResult result = motion_.finish();
    result.held.nodal_vectors += bytes(force_before_) + bytes(mass_);
    return result;
  }

  // of a body that may tear; the first steps are restless however slow the load is
  static constexpr double slowest_at_first = 1.0 / 30000, slowest_in_tearing = 1.0 / 300000;

  static constexpr double smallest_eigenvalue = 1e-8;
  static constexpr double largest_eigenvalue_of_beta = 0.028;  // above it β is too small for α

  const System& system_;
  const SolveOptions& options_;
  std::size_t nodes_;
  Motion motion_;  // its time runs from 0 to 1 while the load's curve is run through, then stays
  NodalVectors force_before_;
  std::vector<double> mass_, moved_, rates_, bounds_;
  double mass_scale_ = 1;
  double lowest_ = 1e-4;  // A_0: a guess until there are increments
  double bound_ = std::numeric_limits<double>::infinity();
  double farthest_ = 0;       // largest |û| on the way, mm
  double force_at_rest_ = 0;  // largest sum of |f_int| of a state at rest, µN
  int load_steps_;
  int calm_ = 0;                       // last rows of the history with a residual as at rest
  double slowest_ = slowest_at_first;  // share of the load's curve a step
  double load_speed_ = 0;              // steps of the load a step
  double load_step_ = 0;
};

}  // namespace

SteppingResult relax(const System& system, const SolveOptions& options, const Progress& progress) {
  SteppingResult result = Relaxation(system, options, false).run(progress);
  if (result.unstable && system.start != nullptr) {
    System from_rest = system;
    from_rest.start = nullptr;
    return relax(from_rest, options, progress);
  }
  if (result.unstable && system.dissection == nullptr) {  // a body that was cut does not heal
    result = Relaxation(system, options, true).run(progress);
    if (result.unstable) {
      result.failure = "tried twice, the second time with the smallest steps: " + result.failure;
    }
  }
  return result;
}

}  // namespace brainshift::solve
