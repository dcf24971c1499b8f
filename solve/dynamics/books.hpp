// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace brainshift::solve {

/// The work that was done on a moving body and where it went, 1e-9 J.
struct Books {
  double external_work = 0, dissipated = 0;
  double largest_work = 0;  ///< |external work| at a look, mJ

  /// A step over which the load's fraction moved on by so much before it. rate: of the work of the reactions by the
  /// fraction; force_work: of the forces over this step; lost: in damping and contact. By the trapezoidal rule.
  void add(double moved_on, double rate, double force_work, double lost) {
    external_work += moved_on * (rate + rate_) / 2 + force_work_;
    rate_ = rate;
    force_work_ = force_work;
    dissipated += lost_ / 2;
    lost_ = lost;
    dissipated += lost_ / 2;
  }

  /// Steps one after the other, as add() would count them: their sums, and those of the first or the last alone.
  struct StepsTaken {
    double moved_on;               ///< before the first
    double rate_first, rate_last;  ///< as `rate`
    double reaction_work;          ///< from the second on
    double force_work, force_work_last;
    double lost, lost_last;
  };
  void add(const StepsTaken& steps) {
    external_work += steps.moved_on * (steps.rate_first + rate_) / 2 + force_work_ + steps.reaction_work +
                     steps.force_work - steps.force_work_last;
    rate_ = steps.rate_last;
    force_work_ = steps.force_work_last;
    dissipated += lost_ / 2 + steps.lost - steps.lost_last / 2;
    lost_ = steps.lost_last;
  }

  /// From here on under the full load.
  void start() { looks_left_ = most_looks; }

  /// At a look, 1e-9 J. The quick motions that a start begins with are no linear body's, and put the balance off by a
  /// fortieth. Until they have died down, for five looks at most, as much work was done as the body holds.
  void look(double strain, double kinetic) {
    constexpr double quick = 1e-3;  // kinetic energy over strain energy
    if (looks_left_ > 0) {
      external_work = strain + kinetic;
      dissipated = 0;
      --looks_left_;
      if (looks_left_ <= most_looks - fewest_looks && kinetic <= quick * strain) {
        looks_left_ = 0;
      }
    }
  }

 private:
  static constexpr int most_looks = 5, fewest_looks = 2;  // of a start, until energies count
  int looks_left_ = 0;
  double rate_ = 0;
  double force_work_ = 0;
  double lost_ = 0;  // from the middle of the step before to that of the last
};

/// ½ v₋ᵀM v₊ with the velocities before and after the last force, and what the damping makes of their difference. With
/// it the balance of central differences is exact for a linear body; with the mean velocity it is off by M|v₊ − v₋|²/8,
/// which a coarse start is full of at first. both, after, earlier: dᵀMd of the last two steps together, the last, and
/// the one before. 1e-9 J.
inline double kinetic_energy(double alpha, double beta, double both, double after, double earlier) {
  return (1 + beta) / (8 * alpha) * (both - after - earlier) + (1 - beta) / (8 * alpha) * (earlier - after);
}

}  // namespace brainshift::solve
