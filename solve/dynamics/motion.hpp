// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "solve/dynamics/books.hpp"
#include "solve/dynamics/rigid_modes.hpp"
#include "solve/dynamics/stepping.hpp"

namespace brainshift::solve {

/// What relaxation and the transient share: the parameters over the last steps, the balance of their energies, and what
/// is kept of them. A step is
///   û⁺ = û + β(û − û⁻) + α M⁻¹ (f_ext − f_int),  then contact, then the essential conditions, then RigidModes.
/// Central differences with the step h and the damping c have α = 2h²/(2 + ch) and β = (2 − ch)/(2 + ch), so that
/// h² = 2α/(1 + β) and c/h = (1 − β)/α. All energies are those at the last force, one step ago.
class Motion {
 public:
  /// The body at rest, without load.
  Motion(Body whole, int snapshot_every);

  /// One step to `time`, where `fraction` of the load holds. mass: one a node, as last given to weigh().
  void step(const PointLaws& laws, std::span<const double> mass, double alpha, double beta, double time,
            double fraction);

  /// Essential conditions and contact push in proportion to 1/mass. alpha: of the steps to come.
  void weigh(std::span<const double> mass, double alpha = 1);

  /// True if the smallest J, of the elastic part where tissue swells, has dropped by a fifth since the last look() or
  /// call that returned true: the body may have stiffened. Notes the first point that turned inside out.
  bool squeezed();

  /// Goes on from û under the full load, at rest. Energies count as Books::look() says. smallest_jacobian: J down to
  /// which squeezed() is not true yet. After weigh().
  void start_from(const NodalVectors& parameters, double smallest_jacobian = 1);

  /// f_int at `now`, of tissues swollen by the fraction of the load there.
  void find_force(const PointLaws& laws);

  /// v ← P⁻¹ v: the masses as a step sees them are `mass`, and P⁻¹ where there are rigid modes.
  void multiply_by_masses(std::span<const double> mass, NodalVectors& v) const;

  /// (x − y)ᵀ P⁻¹ (x − y).
  double inertia(std::span<const double> mass, const NodalVectors& x, const NodalVectors& y) const;

  /// Weighs rigid_modes: see RigidModes::weigh().
  void quicken(std::span<const double> mass, const RigidModes::Matrix& tissue, const RigidModes::Matrix& contact);

  /// Keeps the state and adds a row to the history when the state is sound, else says in result.failure why it is not.
  /// most_imbalance: of the work and what became of it, over the largest of them so far; infinite: not looked at.
  /// Unsound, too, is a motion with more energy than was put in. Returns whether it is sound.
  bool look(const PointLaws& laws, std::span<const double> mass, double most_imbalance);

  /// Asks for a change of the body and goes on with what comes; whether the body changed. Where the change cannot be
  /// made, result.failure says why. time: of the load's curve.
  bool change(const BodyChange& change, const PointLaws& laws, double time, bool may_begin);

  /// Strain and kinetic energy now, 1e-9 J. Of laws that do not relax: else it would be a step of theirs.
  double energy(const PointLaws& laws, std::span<const double> mass);

  /// Of the last step, 1e-9 J.
  double energy_of_motion(std::span<const double> mass) const;

  /// Energy that left the body, 1e-9 J, as when it is cut, or its fictitious masses change.
  void lose(double energy) { books_.dissipated += energy; }

  /// The result, with the last state that was kept.
  SteppingResult finish();

  Body body;
  /// û now and one step ago; after a step `next` is û two steps ago.
  NodalVectors now, before, next;
  NodalVectors force;    ///< f_int − f_ext at `before`, µN
  ForceScratch scratch;  ///< of the last internal force
  /// Of relaxation; none: the masses of a step are those given. They go when the body changes.
  std::optional<RigidModes> rigid_modes;
  SteppingResult result;
  double time = 0;

 private:
  void add_swelling_work(const PointLaws& laws, double next_fraction);
  void go_on_with(ChangedBody changed, const PointLaws& laws);
  LastSteps last_steps() const { return {now, before, next}; }
  void note_broken_point(double smallest_jacobian);
  void keep_snapshot();
  void add_energies(std::span<const double> mass, double alpha, double beta, double fraction);
  double kinetic_energy(std::span<const double> mass) const;
  HistoryRow row(double kinetic, const PointState& state) const;
  double imbalance(const HistoryRow& row);

  NodalVectors good_;
  Points good_reactions_;
  double alpha_ = 1, beta_ = 1;  // of the last step
  double fraction_ = 0;          // of the load, at `now`
  double fraction_before_ = 0;
  double swelling_work_ = 0;  // of swelling over the last step, at its start
  Books books_;
  double largest_energy_ = 0;    // mJ
  double rounding_energy_;       // mJ; energies below it are not compared
  std::optional<Fault> broken_;  // the first point that turned inside out since the last sound state
  double squeezed_to_ = 1;       // J
  int snapshot_every_;
  int next_snapshot_;
};

}  // namespace brainshift::solve
