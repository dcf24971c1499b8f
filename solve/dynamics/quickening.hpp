// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "solve/dynamics/motion.hpp"

namespace brainshift::solve {

/// Finds the RigidModes of a relaxation that is slow under the whole load, or of a body with stiff parts in soft
/// tissue, whose slow motions hide behind quicker ones, and keeps them as they should be: what touches changes from
/// window to window, the tissue's stiffness slowly.
class Quickening {
 public:
  explicit Quickening(double alpha) : alpha_(alpha) {}

  /// Whether the lowest active eigenvalue is so low that what is won is more than what it costs to know.
  static bool wanted(double lowest) { return lowest <= 0.2 * RigidModes::quick; }

  /// Once a window, after look(). lowest: the lowest active eigenvalue of M⁻¹K, as estimated.
  void look(Motion& motion, std::span<const double> mass, double beta, double lowest);

  /// The masses have changed. `motion` has been weighed.
  void weigh(Motion& motion, std::span<const double> mass, double beta);

 private:
  void measure_tissue(Motion& motion);
  RigidModes::Matrix contact(Motion& motion, std::span<const double> mass, double beta);

  double alpha_;
  RigidModes::Matrix tissue_;  ///< Wᵀ K W, µN/mm
  int windows_ = 0;            ///< since there are rigid modes
  NodalVectors state_, resistance_;
};

}  // namespace brainshift::solve
