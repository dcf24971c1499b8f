// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "solve/arrays/nodal_vectors.hpp"
#include "solve/dynamics/motion.hpp"

namespace brainshift::solve {

/// A_0, METHOD.md (22): the lowest eigenvalue of M⁻¹K that is active, as a relaxation learns it from its steps.
class LowestEigenvalue {
 public:
  explicit LowestEigenvalue(std::size_t nodes) : force_before_(4 * nodes, 0.0) {}

  double value() const { return value_; }

  /// As it was before: of an update.
  void hold(double value) { value_ = value; }

  /// Before the last step of a window: keeps the force of the step before it.
  void keep_force(Motion& motion) { std::swap(motion.force, force_before_); }

  /// The body has changed, to one of so many nodes.
  void begin_anew(std::size_t nodes);

  /// What rigid motions of stiff parts would tell of A_0, if they were not hidden behind quicker ones. Now and then
  /// only; cautious: none of the parts has modes of its own.
  void look_at_stiff_parts(Motion& motion, std::span<const double> mass, bool cautious);

  /// At a look, from the last increments, and where these feel rounding from those of the last window, too. Where
  /// conditions give way their springs count. held: of an update, which only goes down.
  void estimate(const Motion& motion, std::span<const double> mass, double alpha, bool rounding_is_felt, bool held);

 private:
  double value_ = 1e-4;                                        // a guess until there are increments
  double of_parts_ = std::numeric_limits<double>::infinity();  // of stiff parts that conditions see
  int next_look_at_parts_ = 0;                                 // step
  NodalVectors force_before_;                                  // one step before the force of a look
  NodalVectors place_at_look_, force_at_look_;  // `before` and the force there of the last look under the whole load
};

}  // namespace brainshift::solve
