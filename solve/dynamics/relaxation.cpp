// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "solve/dynamics/largest_eigenvalue.hpp"
#include "solve/dynamics/stiffness_bound.hpp"

namespace brainshift::solve {

namespace {

constexpr int window = 20;            // steps between looks at the state
constexpr int recent_windows = 4;     // that the error bound looks back on
constexpr double mass_margin = 1.1;   // stiffness may grow by this before the masses are made anew
constexpr double energy_unit = 1e-6;  // g mm²/s² to mJ
constexpr double newton = 1e-6;       // µN to N

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
        scratch_(system.points, system.laws),
        now_(4 * nodes_, 0.0),
        before_(now_),
        next_(now_),
        force_(now_),
        force_before_(now_),
        good_(now_),
        good_reactions_(Points::Zero(static_cast<Eigen::Index>(nodes_), 3)),
        load_steps_(std::max(options.load_steps, 1)),
        next_snapshot_(options.snapshot_every) {
    internal_force(system_.points, system_.laws, now_, scratch_, force_);
    mass_ = stiffness_bound(system_.points, system_.laws, scratch_);
    if (!cautious) {
      mass_scale_ = bound_tightness(system_.points, system_.laws, mass_, mass_);
    }
    for (double& m : mass_) {
      m *= mass_margin * mass_scale_;
    }
    use_masses();
  }

  SteppingResult run(const Progress& progress) {
    while (result_.failure.empty() && result_.steps < options_.max_steps) {
      step();
      if (result_.steps % window == 0) {
        look();
        report_progress(progress);
        if (time_ >= 1 && bound_ <= options_.tolerance) {
          return finish();
        }
      }
    }
    if (result_.failure.empty()) {
      std::ostringstream text;
      text << "not converged after " << result_.steps << " steps: the error bound is " << bound_ << " mm, wanted "
           << options_.tolerance << " mm; allow more steps or a larger tolerance";
      result_.failure = text.str();
    }
    return finish();
  }

 private:
  void use_masses() {
    system_.essential.factorise(mass_);
    if (system_.contact) {
      system_.contact->weigh(mass_);
    }
  }

  void step() {
    if (result_.steps % window == window - 1) {
      std::swap(force_, force_before_);
    }
    internal_force(system_.points, system_.laws, now_, scratch_, force_);
    if (!system_.external.empty()) {
      add_external_force();
    }
    const double beta = critical_beta(lowest_);
    const auto nodes = static_cast<std::int64_t>(nodes_);
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < nodes; ++i) {
      const auto a = static_cast<std::size_t>(i);
      at(next_, a) = at(now_, a) + beta * (at(now_, a) - at(before_, a)) - alpha / mass_[a] * at(force_, a);
    }
    if (system_.contact) {
      system_.contact->apply(next_);
    }
    time_ = std::min(1.0, static_cast<double>(result_.steps + 1) / load_steps_);
    const double fraction = system_.curve.at(time_ * system_.curve.duration());
    system_.essential.apply(fraction, next_);
    add_energies(fraction, beta);
    std::swap(before_, now_);
    std::swap(now_, next_);
    ++result_.steps;
  }

  /// force_ becomes f_int − f_ext.
  void add_external_force() {
    for (std::size_t i = 0; i < force_.size(); ++i) {
      force_[i] -= fraction_ * system_.external[i];
    }
  }

  /// Work of the reactions and the forces by the trapezoidal rule up to û, as the strain energy, and what the damping
  /// takes: c h mass |Δû|²/h². The multipliers are the reactions at û, not at the end of the step.
  void add_energies(double fraction, double beta) {
    const double rate = system_.essential.multiplier_work() / alpha;
    external_work_ += (fraction_ - fraction_before_) * (rate + work_rate_) / 2 + force_work_;
    work_rate_ = rate;
    if (!system_.external.empty()) {
      force_work_ = (fraction + fraction_) / 2 * sum_over_nodes(nodes_, [this](std::size_t a) {
                      return at(system_.external, a).dot(at(next_, a) - at(now_, a));
                    });
    }
    dissipated_ += (1 - beta) / alpha * sum_over_nodes(nodes_, [this](std::size_t a) {
                     return mass_[a] * (at(next_, a) - at(now_, a)).squaredNorm();
                   });
    fraction_before_ = fraction_;
    fraction_ = fraction;
  }

  /// Once a window: is the state sound, how far is it from rest, how fast does it get there?
  void look() {
    const PointState state = point_state(system_.points, system_.laws, scratch_);
    const double motion = largest_difference(now_, before_);
    result_.failure = unsound(state, motion, result_.steps, fraction_);
    if (!result_.failure.empty()) {
      result_.unstable = true;
      return;
    }
    result_.state = state;
    result_.fraction = fraction_;
    good_ = now_;
    good_reactions_ = system_.essential.reactions(alpha, nodes_);
    estimate_lowest_eigenvalue();
    estimate_error(motion);
    record();
    const int windows = result_.steps / window;
    if (windows % (time_ < 1 ? 3 : 10) == 0) {
      follow_stiffness();
    }
  }

  /// A_0 from the last increments: before_ and force_ are one step after next_ and force_before_.
  void estimate_lowest_eigenvalue() {
    const double stiffness = sum_over_nodes(nodes_, [this](std::size_t a) {
      return (at(before_, a) - at(next_, a)).dot(at(force_, a) - at(force_before_, a));
    });
    const double inertia = sum_over_nodes(
        nodes_, [this](std::size_t a) { return mass_[a] * (at(before_, a) - at(next_, a)).squaredNorm(); });
    if (inertia > 0 && stiffness > 0) {
      lowest_ = std::clamp(stiffness / inertia, smallest_eigenvalue, largest_eigenvalue_of_beta);
    }
  }

  /// ρ/(1 − ρ) |û⁺ − û|∞, ρ the slower of the measured rate and of the rate √β that the damping stands for. A passing
  /// low, as when the body swings through a turning point, is no rest: the largest of the last windows counts, for the
  /// rate and for the bound.
  void estimate_error(double motion) {
    motions_.push_back(motion);
    rates_.push_back(std::sqrt(critical_beta(lowest_)));
    bounds_.push_back(std::numeric_limits<double>::infinity());
    if (time_ >= 1 && motions_.size() > recent_windows) {
      const double earlier = *(motions_.end() - 1 - recent_windows);
      const double measured = motion > 0 ? std::pow(motion / earlier, 1.0 / (recent_windows * window)) : 0.0;
      const double rate = std::max(measured, *std::max_element(rates_.end() - recent_windows, rates_.end()));
      bounds_.back() = rate < 1 ? rate / (1 - rate) * motion : bounds_.back();
      bound_ = *std::max_element(bounds_.end() - recent_windows, bounds_.end());
    }
  }

  void record() {
    const double beta = critical_beta(lowest_);
    const double squared_residual = sum_over_nodes(nodes_, [&](std::size_t a) {
      const Eigen::Vector4d push = at(now_, a) - at(before_, a) - beta * (at(before_, a) - at(next_, a));
      return (mass_[a] / alpha * push).squaredNorm();
    });
    const double squared_force = sum_over_nodes(nodes_, [this](std::size_t a) { return at(force_, a).squaredNorm(); });
    const double inertia = sum_over_nodes(
        nodes_, [this](std::size_t a) { return mass_[a] * (at(now_, a) - at(before_, a)).squaredNorm(); });
    HistoryRow row;
    row.step = result_.steps;
    row.time = time_;
    row.external_work = external_work_ * energy_unit;
    row.strain_energy = result_.state.strain_energy * energy_unit;
    row.kinetic_energy = inertia * (1 + beta) / (4 * alpha) * energy_unit;
    row.residual = squared_force > 0 ? std::sqrt(squared_residual / squared_force) : 0;
    row.dissipated_energy = dissipated_ * energy_unit;
    row.reaction = newton * system_.essential.reaction_of_loaded(alpha);
    row.error_bound = bound_;
    result_.history.push_back(row);
    if (options_.snapshot_every > 0 && row.step >= next_snapshot_) {
      result_.snapshots.push_back({row.step, row.time, now_});
      next_snapshot_ += options_.snapshot_every;
    }
  }

  /// Makes the masses anew when a node has become stiffer than they allow for.
  void follow_stiffness() {
    const std::vector<double> bound = stiffness_bound(system_.points, system_.laws, scratch_);
    bool stiffer = false;
    for (std::size_t a = 0; a < nodes_; ++a) {
      stiffer = stiffer || mass_scale_ * bound[a] > mass_[a];
    }
    if (stiffer) {
      for (std::size_t a = 0; a < nodes_; ++a) {
        mass_[a] = std::max(mass_[a], mass_margin * mass_scale_ * bound[a]);
      }
      use_masses();
    }
  }

  void report_progress(const Progress& progress) const {
    std::ostringstream text;
    text << "step " << result_.steps;
    double done = 0.3 * time_;
    if (std::isfinite(bound_)) {
      text << ", error bound " << bound_ << " mm";
      const double decades = std::log10(std::max(bound_ / options_.tolerance, 1.0));
      done = 1 - 0.7 * std::min(decades / 3, 1.0);
    }
    report(progress, done, text.str());
  }

  SteppingResult finish() {
    result_.error_bound = bound_;
    result_.parameters = std::move(good_);
    result_.reactions = std::move(good_reactions_);
    return std::move(result_);
  }

  static constexpr double smallest_eigenvalue = 1e-8;
  static constexpr double largest_eigenvalue_of_beta = 0.028;  // above it β is too small for α

  const System& system_;
  const SolveOptions& options_;
  std::size_t nodes_;
  ForceScratch scratch_;
  NodalVectors now_, before_, next_, force_, force_before_, good_;
  Points good_reactions_;
  std::vector<double> mass_, motions_, rates_, bounds_;
  double mass_scale_ = 1;
  double lowest_ = 1e-4;  // A_0: a guess until there are increments
  double time_ = 0;       // 0 to 1 while the load's curve is run through, then 1
  double fraction_ = 0;   // of the load
  double fraction_before_ = 0;
  double work_rate_ = 0;
  double force_work_ = 0;  // of the forces over the last step
  double external_work_ = 0;
  double dissipated_ = 0;
  double bound_ = std::numeric_limits<double>::infinity();
  int load_steps_;
  int next_snapshot_;
  SteppingResult result_;
};

}  // namespace

SteppingResult relax(const System& system, const SolveOptions& options, const Progress& progress) {
  SteppingResult result = Relaxation(system, options, false).run(progress);
  if (result.unstable) {
    result = Relaxation(system, options, true).run(progress);
  }
  return result;
}

}  // namespace brainshift::solve
