// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/motion.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "solve/arrays/shared_work.hpp"
#include "solve/dynamics/soundness.hpp"
#include "solve/shape/nodal_displacement.hpp"
#include "solve/shape/too_few_nodes.hpp"

namespace brainshift::solve {

namespace {

constexpr double newton = 1e-6;  // µN to N

}  // namespace

Motion::Motion(Body whole, int snapshot_every)
    : body(std::move(whole)),
      now(4 * body.nodes(), 0.0),
      before(now),
      next(now),
      force(now),
      scratch(body.points, body.laws),
      good_(now),
      good_reactions_(Points::Zero(static_cast<Eigen::Index>(body.nodes()), 3)),
      rounding_energy_(rounding_energy(volumes_of_materials(body), body.laws) * energy_unit),
      snapshot_every_(snapshot_every),
      next_snapshot_(snapshot_every) {
  if (body.septum_contact) {
    body.septum_contact->begin_anew();
  }
}

void Motion::weigh(std::span<const double> mass, double alpha) {
  body.essential.factorise(mass, alpha);
  if (body.contact) {
    body.contact->weigh(mass);
  }
  if (body.face_contact) {
    body.face_contact->weigh(mass);
  }
  if (body.wall_contact) {
    body.wall_contact->weigh(mass);
  }
  if (body.septum_contact) {
    body.septum_contact->weigh(mass);
  }
}

void Motion::find_force(const PointLaws& laws) {
  scratch.swell(laws, fraction_);
  internal_force(body.points, laws, now, scratch, force);
}

/// What swelling does to the strain energy at a displacement that stands still: of the fraction's changes before and
/// after the last force each half, as the trapezoidal rule has it.
void Motion::add_swelling_work(const PointLaws& laws, double next_fraction) {
  if (laws.swelling.empty() || (fraction_ == fraction_before_ && next_fraction == fraction_)) {
    return;
  }
  const auto energy_at = [&](double fraction) {
    scratch.swell(laws, fraction);
    return point_state(body.points, laws, scratch).strain_energy;
  };
  const double from = energy_at(fraction_before_), to = energy_at(next_fraction), here = energy_at(fraction_);
  books_.external_work += (swelling_work_ + here - from) / 2;
  swelling_work_ = to - here;
}

void Motion::step(const PointLaws& laws, std::span<const double> mass, double alpha, double beta, double end,
                  double fraction) {
  find_force(laws);
  add_swelling_work(laws, fraction);
  body.external.subtract(fraction_, force);
  const auto nodes = static_cast<std::int64_t>(body.nodes());
  share_work(nodes, nodes_a_part, [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    at(next, a) = at(now, a) + beta * (at(now, a) - at(before, a)) - alpha / mass[a] * at(force, a);
  });
  body.touch(next);
  body.essential.apply(fraction, next);
  if (rigid_modes) {
    rigid_modes->add(mass, beta, now, before, next);
  }
  add_energies(mass, alpha, beta, fraction);
  std::swap(before, now);
  std::swap(now, next);
  alpha_ = alpha;
  beta_ = beta;
  time = end;
  ++result.steps;
}

/// Work of the reactions and the forces by the trapezoidal rule. Lost is what the skull's push takes, and the damping,
/// c m |û⁺ − û⁻|²/(4h): up to û, as the strain energy. With the velocity over both steps the balance is exact for a
/// linear body, in its fastest modes, too, which a coarse start is full of. The multipliers are the reactions at û, not
/// at the end of the step.
void Motion::add_energies(std::span<const double> mass, double alpha, double beta, double fraction) {
  double lost = 0;
  if (beta < 1) {
    lost = (1 - beta) / (4 * alpha) * inertia(mass, next, before);
  }
  if (body.contact) {
    lost -= body.contact->push_work(before, next) / alpha;
  }
  if (body.septum_contact) {
    lost -= body.septum_contact->push_work(before, next) / alpha;
  }
  books_.add(fraction_ - fraction_before_, body.essential.multiplier_work() / alpha,
             body.external.work(fraction_, fraction, now, next), lost);
  if (beta != beta_ && alpha == alpha_) {  // relaxation damps anew: with h² = 2α/(1 + β) the energy of motion jumps
    books_.dissipated += (beta_ - beta) / (4 * alpha) * inertia(mass, now, before);
  }
  fraction_before_ = fraction_;
  fraction_ = fraction;
}

double Motion::inertia(std::span<const double> mass, const NodalVectors& x, const NodalVectors& y) const {
  const double whole =
      sum_over_nodes(body.nodes(), [&, mass](std::size_t a) { return mass[a] * (at(x, a) - at(y, a)).squaredNorm(); });
  return rigid_modes ? whole - rigid_modes->less_inertia(mass, x, y) : whole;
}

void Motion::multiply_by_masses(std::span<const double> mass, NodalVectors& v) const {
  if (rigid_modes) {
    rigid_modes->lighten(mass, v);
  }
  for (std::size_t a = 0; a < body.nodes(); ++a) {
    at(v, a) *= mass[a];
  }
}

/// The energy of motion jumps, as where the damping changes.
void Motion::quicken(std::span<const double> mass, const RigidModes::Matrix& tissue,
                     const RigidModes::Matrix& contact) {
  const double before_that = energy_of_motion(mass);
  rigid_modes->weigh(mass, tissue, contact);
  lose(before_that - energy_of_motion(mass));
}

double Motion::energy_of_motion(std::span<const double> mass) const {
  return (1 + beta_) / (4 * alpha_) * inertia(mass, now, before);
}

void Motion::start_from(const NodalVectors& parameters, double smallest_jacobian) {
  now = parameters;
  fraction_ = fraction_before_ = 1;
  time = 1;
  body.essential.apply(fraction_, now);
  before = next = good_ = now;
  squeezed_to_ = smallest_jacobian;
  books_.start();
}

bool Motion::squeezed() {
  const double smallest = jacobian_range(scratch).smallest;
  note_broken_point(smallest);
  if (smallest >= squeezed_share * squeezed_to_) {
    return false;
  }
  squeezed_to_ = smallest;
  return true;
}

void Motion::note_broken_point(double smallest_jacobian) {
  if (!(smallest_jacobian > 0) && !broken_) {
    broken_ = broken_point(body.points, scratch, last_steps());
  }
}

bool Motion::look(const PointLaws& laws, std::span<const double> mass, double most_imbalance) {
  const PointState state = point_state(body.points, laws, scratch);
  const double kinetic = kinetic_energy(mass);
  books_.look(state.strain_energy, kinetic);
  const HistoryRow latest = row(kinetic, state);
  books_.largest_work = std::max(books_.largest_work, std::abs(latest.external_work));
  const double motion = inertia(mass, now, next) * (1 + beta_) / (16 * alpha_) * energy_unit;
  if (const std::string fault = unsound(state, largest_difference(now, before)); !fault.empty()) {
    note_broken_point(state.smallest_jacobian);
    mark_unstable(fault, time, fraction_, broken_ ? *broken_ : restless_node(last_steps()), result);
  } else if (imbalance(latest) > most_imbalance ||
             motion > most_motion * std::max(books_.largest_work, rounding_energy_)) {
    mark_unstable(unbalanced(latest), time, fraction_, restless_node(last_steps()), result);
  }
  if (result.unstable) {
    return false;
  }
  broken_.reset();
  result.state = state;
  result.fraction = fraction_;
  squeezed_to_ = jacobian_range(scratch).smallest;  // as squeezed() has it: of what swells, without its growth
  good_ = now;
  good_reactions_ = body.essential.reactions(alpha_, body.nodes());
  result.history.push_back(latest);
  if (snapshot_every_ > 0 && result.steps >= next_snapshot_) {
    keep_snapshot();
  }
  return true;
}

void Motion::keep_snapshot() {
  Snapshot snapshot;
  snapshot.step = result.steps;
  snapshot.time = time;
  snapshot.displacement = nodal_displacement(body.nodal_rows, now, body.original);
  snapshot.positions = body.positions;
  snapshot.cut = body.cut;
  result.snapshots.push_back(std::move(snapshot));
  next_snapshot_ += snapshot_every_;
}

double Motion::kinetic_energy(std::span<const double> mass) const {
  return solve::kinetic_energy(alpha_, beta_, inertia(mass, now, next), inertia(mass, now, before),
                               inertia(mass, before, next));
}

HistoryRow Motion::row(double kinetic, const PointState& state) const {
  HistoryRow row;
  row.step = result.steps;
  row.time = time;
  row.external_work = books_.external_work * energy_unit;
  row.strain_energy = state.strain_energy * energy_unit;
  row.kinetic_energy = kinetic * energy_unit;
  row.dissipated_energy = books_.dissipated * energy_unit;
  row.reaction = newton * body.essential.reaction_of_loaded(alpha_);
  return row;
}

/// |external work − what it became| over the largest of the two so far.
double Motion::imbalance(const HistoryRow& row) {
  const double became = row.strain_energy + row.kinetic_energy + row.dissipated_energy;
  largest_energy_ = std::max({largest_energy_, std::abs(row.external_work), became});
  return largest_energy_ > rounding_energy_ ? std::abs(row.external_work - became) / largest_energy_ : 0;
}

bool Motion::change(const BodyChange& change, const PointLaws& laws, double curve_time, bool may_begin) {
  Moment moment{.time = curve_time,
                .first = true,
                .moves = result.steps > 0,
                .may_begin = may_begin,
                .body = body,
                .laws = laws,
                .scratch = scratch};
  try {
    while (std::optional<ChangedBody> changed = change.next(moment)) {
      go_on_with(std::move(*changed), laws);
      moment.first = false;
    }
  } catch (const TooFewNodes& error) {
    std::ostringstream text;
    text << "the cut cannot go on at step " << result.steps << ", time " << curve_time << ": " << error.what();
    result.failure = text.str();
  }
  return !moment.first;
}

void Motion::go_on_with(ChangedBody changed, const PointLaws& laws) {
  body = std::move(changed.body);
  rigid_modes.reset();
  for (NodalVectors* v : {&now, &before, &next, &good_}) {
    *v = changed.parameters(*v);
  }
  force.assign(4 * body.nodes(), 0.0);
  const auto nodes = static_cast<Eigen::Index>(body.nodes());
  const Eigen::Index more = nodes - good_reactions_.rows();
  good_reactions_.conservativeResize(nodes, 3);
  good_reactions_.bottomRows(more).setZero();
  ForceScratch fresh(body.points, laws);
  fresh.swell(laws, fraction_);
  fresh.parameters = changed.parameters(scratch.parameters);
  fresh.remember(scratch, changed.point_from);
  scratch = std::move(fresh);
}

double Motion::energy(const PointLaws& laws, std::span<const double> mass) {
  find_force(laws);
  return point_state(body.points, laws, scratch).strain_energy + energy_of_motion(mass);
}

SteppingResult Motion::finish() {
  result.body = std::move(body);
  result.parameters = std::move(good_);
  result.reactions = std::move(good_reactions_);
  return std::move(result);
}

}  // namespace brainshift::solve
