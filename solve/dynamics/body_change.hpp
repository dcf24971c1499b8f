// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "solve/body/body.hpp"
#include "solve/force/force_scratch.hpp"

namespace brainshift::solve {

/// A body after a change on the way, and how its motion goes on from that of the body before.
struct ChangedBody {
  Body body;
  std::function<NodalVectors(const NodalVectors&)> parameters;  ///< of the new body's nodes, from those before
  std::vector<std::int32_t> point_from;                         ///< number before of each integration point
};

/// The motion as a change of the body sees it.
struct Moment {
  double time;                  ///< of the load's curve
  bool first;                   ///< the first question between two steps; false: it has changed the body already
  bool moves;                   ///< the body has been stepped
  bool may_begin;               ///< a tear may begin where there is none; else those that are there go on
  const Body& body;             ///< as it is now
  const PointLaws& laws;        ///< of its points, with the Prony factors of the step
  const ForceScratch& scratch;  ///< of the last internal_force()
};

/// Something that changes the body on the way, as a cut that goes on does. Time stepping asks it between steps.
struct BodyChange {
  /// Whether a change is due at a time of the load's curve, whatever the body's state.
  std::function<bool(double time)> is_due;
  /// The body from now on; nothing: it stays as it is. Asked again until it stays. Throws TooFewNodes where the change
  /// that is due cannot be made; nothing has changed then.
  std::function<std::optional<ChangedBody>(const Moment&)> next;
  /// Whether all that is due by some time has come.
  std::function<bool()> is_done;
  /// Whether the body's state decides, as of a tear: then it is looked at often, and relaxation loads the body so
  /// slowly that it stays near rest.
  bool by_state = false;

  explicit operator bool() const { return static_cast<bool>(next); }
};

}  // namespace brainshift::solve
