// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "solve/device/view.hpp"
#include "solve/force/internal_force.hpp"

namespace brainshift::solve::device {

/// What is still to go as SpanBound::value() has it, mm, once two spans are known.
double left_by_spans(const LookSums& look);

/// volume: of each material, mm³.
PointState point_state(const LookSums& look, std::span<const double> volume);

/// A_0 from the last increments and, where asked for, from those of the last window if that is less; not above 0: they
/// do not tell.
double lowest_eigenvalue(const LookSums& look, bool of_window);

}  // namespace brainshift::solve::device
