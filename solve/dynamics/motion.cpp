// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/motion.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace brainshift::solve {

namespace {

constexpr double energy_unit = 1e-6;  // g mm²/s² to mJ
constexpr double newton = 1e-6;       // µN to N

/// One sentence when the state is not sound: displacements that are no longer finite, a point that turned inside out;
/// else empty. moved: largest |û⁺ − û| of the last step.
std::string unsound(const PointState& state, double moved, int step, double fraction) {
  if (std::isfinite(moved) && state.smallest_jacobian > 0) {
    return {};
  }
  std::ostringstream text;
  text << "unstable at step " << step << " with " << 100 * fraction << " % of the load: ";
  if (std::isfinite(moved)) {
    text << "an integration point turned inside out (J = " << state.smallest_jacobian << ")";
  } else {
    text << "displacements are no longer finite";
  }
  text << "; the load is too large for this cloud, or a material too soft beside its neighbour";
  return text.str();
}

std::string unbalanced(const HistoryRow& row) {
  std::ostringstream text;
  text << "unstable at step " << row.step << ", " << row.time << " s: the work of " << row.external_work
       << " mJ has become " << row.strain_energy << " mJ of strain, " << row.kinetic_energy << " mJ of motion and "
       << row.dissipated_energy << " mJ in the damping, which is not the same; take a smaller time step";
  return text.str();
}

}  // namespace

Motion::Motion(const System& system, const PointLaws& laws, int snapshot_every)
    : now(4 * system.points.nodes(), 0.0),
      before(now),
      next(now),
      force(now),
      scratch(system.points, laws),
      system_(system),
      nodes_(system.points.nodes()),
      good_(now),
      good_reactions_(Points::Zero(static_cast<Eigen::Index>(nodes_), 3)),
      snapshot_every_(snapshot_every),
      next_snapshot_(snapshot_every) {}

void Motion::weigh(std::span<const double> mass) {
  system_.essential.factorise(mass);
  if (system_.contact) {
    system_.contact->weigh(mass);
  }
}

void Motion::step(const PointLaws& laws, std::span<const double> mass, double alpha, double beta, double end,
                  double fraction) {
  internal_force(system_.points, laws, now, scratch, force);
  for (std::size_t i = 0; i < system_.external.size(); ++i) {
    force[i] -= fraction_ * system_.external[i];
  }
  const auto nodes = static_cast<std::int64_t>(nodes_);
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < nodes; ++i) {
    const auto a = static_cast<std::size_t>(i);
    at(next, a) = at(now, a) + beta * (at(now, a) - at(before, a)) - alpha / mass[a] * at(force, a);
  }
  if (system_.contact) {
    system_.contact->apply(next);
  }
  system_.essential.apply(fraction, next);
  add_energies(mass, alpha, beta, fraction);
  std::swap(before, now);
  std::swap(now, next);
  alpha_ = alpha;
  beta_ = beta;
  time = end;
  ++result.steps;
}

/// Work of the reactions and the forces by the trapezoidal rule, and what the damping takes, c m |Δû|²/h: up to û, as
/// the strain energy. The multipliers are the reactions at û, not at the end of the step.
void Motion::add_energies(std::span<const double> mass, double alpha, double beta, double fraction) {
  const double rate = system_.essential.multiplier_work() / alpha;
  external_work_ += (fraction_ - fraction_before_) * (rate + work_rate_) / 2 + force_work_;
  work_rate_ = rate;
  if (!system_.external.empty()) {
    force_work_ = (fraction + fraction_) / 2 * sum_over_nodes(nodes_, [this](std::size_t a) {
                    return at(system_.external, a).dot(at(next, a) - at(now, a));
                  });
  }
  if (beta < 1) {
    dissipated_ += damping_work_;
    damping_work_ = (1 - beta) / alpha * sum_over_nodes(nodes_, [this, mass](std::size_t a) {
                      return mass[a] * (at(next, a) - at(now, a)).squaredNorm();
                    });
  }
  fraction_before_ = fraction_;
  fraction_ = fraction;
}

bool Motion::squeezed() {
  constexpr double much = 0.8;
  const double smallest = jacobian_range(scratch).smallest;
  if (smallest >= much * squeezed_to_) {
    return false;
  }
  squeezed_to_ = smallest;
  return true;
}

bool Motion::look(const PointLaws& laws, std::span<const double> mass, double most_imbalance) {
  const PointState state = point_state(system_.points, laws, scratch);
  const HistoryRow latest = row(mass, state);
  result.failure = unsound(state, largest_difference(now, before), result.steps, fraction_);
  if (result.failure.empty() && imbalance(latest) > most_imbalance) {
    result.failure = unbalanced(latest);
  }
  if (!result.failure.empty()) {
    result.unstable = true;
    return false;
  }
  result.state = state;
  result.fraction = fraction_;
  squeezed_to_ = state.smallest_jacobian;
  good_ = now;
  good_reactions_ = system_.essential.reactions(alpha_, nodes_);
  result.history.push_back(latest);
  if (snapshot_every_ > 0 && result.steps >= next_snapshot_) {
    result.snapshots.push_back({result.steps, time, now});
    next_snapshot_ += snapshot_every_;
  }
  return true;
}

/// The velocity at the last force is that over the steps on its two sides.
HistoryRow Motion::row(std::span<const double> mass, const PointState& state) const {
  const double inertia = sum_over_nodes(
      nodes_, [this, mass](std::size_t a) { return mass[a] * (at(now, a) - at(next, a)).squaredNorm(); });
  HistoryRow row;
  row.step = result.steps;
  row.time = time;
  row.external_work = external_work_ * energy_unit;
  row.strain_energy = state.strain_energy * energy_unit;
  row.kinetic_energy = inertia * (1 + beta_) / (16 * alpha_) * energy_unit;
  row.dissipated_energy = dissipated_ * energy_unit;
  row.reaction = newton * system_.essential.reaction_of_loaded(alpha_);
  return row;
}

/// |external work − what it became| over the largest of the two so far.
double Motion::imbalance(const HistoryRow& row) {
  const double became = row.strain_energy + row.kinetic_energy + row.dissipated_energy;
  largest_energy_ = std::max({largest_energy_, std::abs(row.external_work), became});
  return largest_energy_ > 0 ? std::abs(row.external_work - became) / largest_energy_ : 0;
}

SteppingResult Motion::finish() {
  result.held = held();
  result.parameters = std::move(good_);
  result.reactions = std::move(good_reactions_);
  return std::move(result);
}

}  // namespace brainshift::solve
