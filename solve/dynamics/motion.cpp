// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/motion.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "solve/cut/dissection.hpp"
#include "solve/nodal_displacement.hpp"

namespace brainshift::solve {

namespace {

constexpr double energy_unit = 1e-6;  // g mm²/s² to mJ
constexpr double newton = 1e-6;       // µN to N

/// An undamped motion holds at most what was put in, and its energy is known to a few percent.
constexpr double most_motion = 2;

/// What is wrong with the state of the points; empty: nothing. moved: largest |û⁺ − û| of the last step.
std::string unsound(const PointState& state, double moved) {
  if (!std::isfinite(moved)) {
    return "displacements are no longer finite";
  }
  if (!(state.smallest_jacobian > 0)) {
    std::ostringstream text;
    text << "an integration point turned inside out (J = " << state.smallest_jacobian << ")";
    return text.str();
  }
  return {};
}

std::string unbalanced(const HistoryRow& row) {
  std::ostringstream text;
  text << "the work of " << row.external_work << " mJ has become " << row.strain_energy << " mJ of strain, "
       << row.kinetic_energy << " mJ of motion and " << row.dissipated_energy
       << " mJ in the damping, which is not the same, most of all";
  return text.str();
}

/// Energy of a strain so small that rounding is a good part of it: one of 1e-6, mJ.
double rounding_energy(const System& system) {
  double stiffness = 0;
  for (const Patch& patch : system.points.patches) {
    const double modulus = std::visit([](const auto& law) { return law.shear_modulus; },
                                      system.laws.elastic[static_cast<std::size_t>(patch.material)]);
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      stiffness += modulus * system.points.volume[static_cast<std::size_t>(p)];
    }
  }
  return 1e-12 * stiffness * energy_unit;
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
      rounding_energy_(rounding_energy(system)),
      snapshot_every_(snapshot_every),
      next_snapshot_(snapshot_every) {}

void Motion::weigh(std::span<const double> mass) {
  system_.essential.factorise(mass);
  if (system_.contact) {
    system_.contact->weigh(mass);
  }
  if (system_.face_contact != nullptr) {
    system_.face_contact->weigh(mass);
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
  if (system_.face_contact != nullptr) {
    system_.face_contact->apply(next);
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

void Motion::start_from(const NodalVectors& parameters, const PointLaws& laws) {
  now = parameters;
  fraction_ = fraction_before_ = 1;
  time = 1;
  system_.essential.apply(fraction_, now);
  before = next = now;
  internal_force(system_.points, laws, now, scratch, force);
  external_work_ = point_state(system_.points, laws, scratch).strain_energy;
}

bool Motion::squeezed() {
  constexpr double much = 0.8;
  const double smallest = jacobian_range(scratch).smallest;
  note_broken_point(smallest);
  if (smallest >= much * squeezed_to_) {
    return false;
  }
  squeezed_to_ = smallest;
  return true;
}

void Motion::note_broken_point(double smallest_jacobian) {
  if (!(smallest_jacobian > 0) && !broken_) {
    broken_ = broken_point(system_.points, scratch, last_steps());
  }
}

bool Motion::look(const PointLaws& laws, std::span<const double> mass, double most_imbalance) {
  const PointState state = point_state(system_.points, laws, scratch);
  const HistoryRow latest = row(mass, state);
  largest_work_ = std::max(largest_work_, std::abs(latest.external_work));
  if (const std::string fault = unsound(state, largest_difference(now, before)); !fault.empty()) {
    note_broken_point(state.smallest_jacobian);
    fail(fault, latest, broken_ ? *broken_ : restless_node(last_steps()));
  } else if (imbalance(latest) > most_imbalance ||
             latest.kinetic_energy > most_motion * std::max(largest_work_, rounding_energy_)) {
    fail(unbalanced(latest), latest, restless_node(last_steps()));
  }
  if (result.unstable) {
    return false;
  }
  broken_.reset();
  result.state = state;
  result.fraction = fraction_;
  squeezed_to_ = state.smallest_jacobian;
  good_ = now;
  good_reactions_ = system_.essential.reactions(alpha_, nodes_);
  result.history.push_back(latest);
  if (snapshot_every_ > 0 && result.steps >= next_snapshot_) {
    result.snapshots.push_back(
        {result.steps, time, nodal_displacement(system_.nodal_rows, now, system_.original), Points(0, 3), CutFacets()});
    if (system_.dissection != nullptr) {
      result.snapshots.back().positions = system_.dissection->positions();
      result.snapshots.back().cut = system_.dissection->facets();
    }
    next_snapshot_ += snapshot_every_;
  }
  return true;
}

void Motion::fail(const std::string& why, const HistoryRow& latest, const Fault& fault) {
  std::ostringstream text;
  text << "unstable at step " << result.steps << " (time " << latest.time << ") with " << 100 * fraction_
       << " % of the load: " << why;
  result.failure = text.str();
  result.unstable = true;
  result.fault = fault;
  result.fault->fast =
      !result.history.empty() && result.history.back().kinetic_energy > result.history.back().strain_energy;
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
  return largest_energy_ > rounding_energy_ ? std::abs(row.external_work - became) / largest_energy_ : 0;
}

void Motion::carry_over(const PointLaws& laws, const std::function<NodalVectors(const NodalVectors&)>& map,
                        std::span<const std::int32_t> point_from) {
  for (NodalVectors* v : {&now, &before, &next, &good_}) {
    *v = map(*v);
  }
  nodes_ = system_.points.nodes();
  force.assign(4 * nodes_, 0.0);
  const Eigen::Index more = static_cast<Eigen::Index>(nodes_) - good_reactions_.rows();
  good_reactions_.conservativeResize(static_cast<Eigen::Index>(nodes_), 3);
  good_reactions_.bottomRows(more).setZero();
  ForceScratch fresh(system_.points, laws);
  fresh.parameters = map(scratch.parameters);
  fresh.remember(scratch, point_from);
  scratch = std::move(fresh);
}

bool Motion::go_on_cutting(Dissection& dissection, const PointLaws& laws, double cut_time, bool may_begin) {
  bool changed = false;
  if (dissection.is_due(cut_time)) {
    try {
      dissection.cut(cut_time, laws, *this);
      changed = true;
    } catch (const std::invalid_argument& error) {
      std::ostringstream text;
      text << "the cut cannot go on at step " << result.steps << ", time " << cut_time << ": " << error.what();
      result.failure = text.str();
      return false;
    }
  }
  const bool moves = result.steps > 0;
  return (moves && dissection.may_tear() && dissection.tear(laws, *this, may_begin)) || changed;
}

double Motion::energy(const PointLaws& laws, std::span<const double> mass) {
  internal_force(system_.points, laws, now, scratch, force);
  const double motion = sum_over_nodes(
      nodes_, [this, mass](std::size_t a) { return mass[a] * (at(now, a) - at(before, a)).squaredNorm(); });
  return point_state(system_.points, laws, scratch).strain_energy + motion * (1 + beta_) / (4 * alpha_);
}

SteppingResult Motion::finish() {
  result.held = held();
  result.parameters = std::move(good_);
  result.reactions = std::move(good_reactions_);
  return std::move(result);
}

}  // namespace brainshift::solve
