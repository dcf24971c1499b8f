// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/transient.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "solve/dynamics/largest_eigenvalue.hpp"
#include "solve/dynamics/stiffness_bound.hpp"

namespace brainshift::solve {

namespace {

constexpr int look_every = 50;        // steps between looks at the state
constexpr double safety = 0.9;        // of the critical step
constexpr double energy_unit = 1e-6;  // g mm²/s² to mJ
constexpr double newton = 1e-6;       // µN to N

class Transient {
 public:
  Transient(const System& system, const std::vector<std::vector<PronyTerm>>& prony, std::span<const double> mass,
            const SolveOptions& options)
      : system_(system),
        laws_(system.laws),
        prony_(prony),
        mass_(mass.begin(), mass.end()),
        options_(options),
        nodes_(system.points.nodes()),
        now_(4 * nodes_, 0.0),
        before_(now_),
        next_(now_),
        force_(now_),
        good_(now_),
        good_reactions_(Points::Zero(static_cast<Eigen::Index>(nodes_), 3)),
        next_snapshot_(options.snapshot_every),
        scratch_(system.points, PointLaws{{}, {}, system.laws.plane_stress}) {
    internal_force(system_.points, system_.laws, now_, scratch_, force_);
    tightness_ =
        bound_tightness(system.points, system.laws, stiffness_bound(system.points, system.laws, scratch_), mass_);
    const double critical = critical_now();
    if (options.time_step > critical) {
      std::ostringstream text;
      text << "the time step of " << options.time_step << " s is above the critical one, " << critical
           << " s: the motion would blow up; leave it out (0) or take a smaller one";
      throw std::invalid_argument(text.str());
    }
    set_step(options.time_step > 0 ? options.time_step : safety * critical);
    scratch_ = ForceScratch(system.points, laws_);
    system_.essential.factorise(mass_);
    if (system_.contact) {
      system_.contact->weigh(mass_);
    }
  }

  SteppingResult run(const Progress& progress) {
    const double end = system_.curve.duration();
    while (result_.failure.empty() && time_ < end - step_ / 2) {
      if (result_.steps == options_.max_steps) {
        result_.failure = "stopped after " + std::to_string(result_.steps) + " steps, at " + std::to_string(time_) +
                          " s of " + std::to_string(end) + " s; allow more steps";
        break;
      }
      step(time_ + step_);
      if (result_.steps % look_every == 0 || time_ >= end - step_ / 2) {
        look();
        report(progress, time_ / end, "step " + std::to_string(result_.steps));
      }
    }
    result_.parameters = std::move(good_);
    result_.reactions = std::move(good_reactions_);
    return std::move(result_);
  }

 private:
  double critical_now() const { return critical_step(stiffness_bound(system_.points, system_.laws, scratch_), mass_); }

  /// Takes a step of at most h that divides the time left; the last increment is scaled so that the velocity stays.
  void set_step(double most) {
    const double left = system_.curve.duration() - time_;
    const double h = left / std::ceil(left / most);
    const double ratio = step_ > 0 ? h / step_ : 1;
    for (std::size_t i = 0; i < now_.size(); ++i) {
      before_[i] = now_[i] - ratio * (now_[i] - before_[i]);
    }
    step_ = h;
    laws_.prony.clear();
    for (const std::vector<PronyTerm>& terms : prony_) {
      laws_.prony.emplace_back(terms, h);
    }
  }

  void step(double time) {
    internal_force(system_.points, laws_, now_, scratch_, force_);
    const double ch = options_.damping * step_;
    const double alpha = 2 * step_ * step_ / (2 + ch), beta = (2 - ch) / (2 + ch);
    const auto nodes = static_cast<std::int64_t>(nodes_);
    const bool pushed = !system_.external.empty();
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < nodes; ++i) {
      const auto a = static_cast<std::size_t>(i);
      Eigen::Vector4d push = -at(force_, a);
      if (pushed) {
        push += fraction_ * at(system_.external, a);
      }
      at(next_, a) = at(now_, a) + beta * (at(now_, a) - at(before_, a)) + alpha / mass_[a] * push;
    }
    if (system_.contact) {
      system_.contact->apply(next_);
    }
    const double fraction = system_.curve.at(time);
    system_.essential.apply(fraction, next_);
    add_energies(fraction, alpha);
    std::swap(before_, now_);
    std::swap(now_, next_);
    time_ = time;
    alpha_ = alpha;
    ++result_.steps;
  }

  /// Work of the reactions and the forces by the trapezoidal rule, and what the damping takes, c m |v|² h: up to û, as
  /// the strain energy. The multipliers are the reactions at û, not at the end of the step.
  void add_energies(double fraction, double alpha) {
    const double rate = system_.essential.multiplier_work() / alpha;
    external_work_ += (fraction_ - fraction_before_) * (rate + work_rate_) / 2 + force_work_;
    work_rate_ = rate;
    if (!system_.external.empty()) {
      force_work_ = (fraction + fraction_) / 2 * sum_over_nodes(nodes_, [this](std::size_t a) {
                      return at(system_.external, a).dot(at(next_, a) - at(now_, a));
                    });
    }
    if (options_.damping > 0) {
      dissipated_ += damping_work_;
      damping_work_ = options_.damping / step_ * sum_over_nodes(nodes_, [this](std::size_t a) {
                        return mass_[a] * (at(next_, a) - at(now_, a)).squaredNorm();
                      });
    }
    fraction_before_ = fraction_;
    fraction_ = fraction;
  }

  void look() {
    const PointState state = point_state(system_.points, laws_, scratch_);
    result_.failure = unsound(state, largest_difference(now_, before_), result_.steps, fraction_);
    if (!result_.failure.empty()) {
      result_.unstable = true;
      return;
    }
    result_.state = state;
    result_.fraction = fraction_;
    good_ = now_;
    good_reactions_ = system_.essential.reactions(alpha_, nodes_);
    record();
    follow_stiffness();
  }

  /// All energies are those at the last force, one step ago; the velocity there is that over the steps on its two
  /// sides.
  void record() {
    const double inertia = sum_over_nodes(nodes_, [this](std::size_t a) {
      return mass_[a] * (at(now_, a) - at(next_, a)).squaredNorm();  // next_ holds the state before before_
    });
    HistoryRow row;
    row.step = result_.steps;
    row.time = time_;
    row.external_work = external_work_ * energy_unit;
    row.strain_energy = result_.state.strain_energy * energy_unit;
    row.kinetic_energy = inertia / (8 * step_ * step_) * energy_unit;
    row.dissipated_energy = dissipated_ * energy_unit;
    row.reaction = newton * system_.essential.reaction_of_loaded(alpha_);
    result_.history.push_back(row);
    if (options_.snapshot_every > 0 && row.step >= next_snapshot_) {
      result_.snapshots.push_back({row.step, row.time, now_});
      next_snapshot_ += options_.snapshot_every;
    }
  }

  void follow_stiffness() {
    const double critical = critical_now();
    if (step_ <= critical || time_ >= system_.curve.duration() - step_ / 2) {
      return;
    }
    if (options_.time_step > 0) {
      std::ostringstream text;
      text << "at step " << result_.steps << ", " << time_
           << " s, the body has become so stiff that the critical step is " << critical
           << " s, below the given one; leave it out (0) or take a smaller one";
      result_.failure = text.str();
      return;
    }
    set_step(safety * critical);
  }

  const System& system_;
  PointLaws laws_;  ///< with the Prony factors of the step
  const std::vector<std::vector<PronyTerm>>& prony_;
  std::vector<double> mass_;
  const SolveOptions& options_;
  std::size_t nodes_;
  NodalVectors now_, before_, next_, force_, good_;
  Points good_reactions_;
  double tightness_ = 1;
  double step_ = 0;   // h, s
  double alpha_ = 1;  // of the last step, s²
  double time_ = 0;   // s
  double fraction_ = 0;
  double fraction_before_ = 0;
  double work_rate_ = 0;
  double force_work_ = 0;  // of the forces over the last step
  double external_work_ = 0;
  double damping_work_ = 0;  // over the last step
  double dissipated_ = 0;
  int next_snapshot_;
  ForceScratch scratch_;
  SteppingResult result_;
};

}  // namespace

SteppingResult march(const System& system, const std::vector<std::vector<PronyTerm>>& prony,
                     std::span<const double> mass, const SolveOptions& options, const Progress& progress) {
  return Transient(system, prony, mass, options).run(progress);
}

}  // namespace brainshift::solve
