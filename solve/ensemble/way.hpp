// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "solve/dynamics/error_bound.hpp"
#include "solve/dynamics/quickening.hpp"
#include "solve/dynamics/relaxation.hpp"
#include "solve/dynamics/relaxation_rules.hpp"
#include "solve/ensemble/member.hpp"

namespace brainshift::solve {

/// What a look finds of a member, with what it has moved by since the step before, mm.
struct SeenOfMember {
  double moved, farthest;
  double smallest_jacobian;
  double lowest;            ///< A_0; not above 0: the increments do not tell
  double motion_over_work;  ///< EachMotion::motion_over_work()
};

/// One member on its way to rest, by the rules of relax(), wherever it is stepped.
struct Way {
  double mass_scale = 1;
  double lowest = 1e-4;  // A_0: a guess until there are increments
  ErrorBound bound{usual_window};
  double farthest = 0;     // largest |û| on the way, mm
  double squeezed_to = 1;  // J
  bool started = false;    // under the full load
  int steps = 0;           // up to the last look

  double beta() const { return critical_beta(damped_eigenvalue(lowest, steps, started)); }

  /// The farthest that it has been, with what is seen now.
  double farthest_with(double seen) const { return std::max(farthest, seen); }

  /// Once a window. loaded: the whole load is on. Returns whether it may go on; else it is unstable.
  bool look(const SeenOfMember& seen, bool loaded, Precision precision) {
    if (!std::isfinite(seen.moved) || !(seen.smallest_jacobian > 0) || seen.motion_over_work > 1) {
      return false;
    }
    squeezed_to = seen.smallest_jacobian;
    if (seen.lowest > 0) {
      lowest = bounded_eigenvalue(seen.lowest);
    }
    farthest = farthest_with(seen.farthest);
    bound.add(seen.moved, std::sqrt(critical_beta(lowest)), loaded, rounding_of_step(farthest, precision),
              damped_rate(lowest, steps, started));
    steps += usual_window;
    return true;
  }

  /// How it ends after a look, if it does. spans: value() of its SpanBound, and reset(). patient: a slow one stays, be
  /// it rounded.
  template <class Spans>
  std::optional<MemberResult::End> end(double tolerance, bool loaded, bool patient, Precision precision, Spans& spans) {
    using End = MemberResult::End;
    const double wanted = wanted_bound(tolerance, farthest);
    if (!patient && loaded && bound.value() > far_from_rest * wanted && Quickening::wanted(lowest)) {
      return End::left;
    }
    if (loaded && bound.with_spans(spans.value()) <= wanted) {
      return End::rest;
    }
    if (!patient && outlasts(precision, bound.loaded_steps(), farthest, wanted)) {
      return End::left;
    }
    if (!bound.stands_still(rounding_of_step(farthest, precision))) {
      return std::nullopt;
    }
    const double left = bound.at_standstill(std::sqrt(critical_beta(smallest_eigenvalue)));
    spans.reset();
    const bool single = precision == Precision::single_precision;  // double precision may get further
    return left <= wanted ? End::rest : single ? End::left : End::not_converged;
  }
};

}  // namespace brainshift::solve
