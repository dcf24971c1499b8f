// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solve/dynamics/stepping.hpp"

namespace brainshift::solve {

// Whether a motion may go on: relax(), march(), an ensemble and a device all ask.

inline constexpr double energy_unit = 1e-6;  // g mm²/s² to mJ

/// An undamped motion holds at most what was put in, and its energy is known to a few percent.
inline constexpr double most_motion = 2;

/// Of J since the masses were made, below which the body may have become stiffer than they allow for.
inline constexpr double squeezed_share = 0.8;

/// What is wrong with the state of the points; empty: nothing. moved: largest |û⁺ − û| of the last step.
std::string unsound(const PointState& state, double moved);

/// Says in the result that it is unstable at its last step, which has this time and fraction of the load.
void mark_unstable(const std::string& why, double time, double fraction, const Fault& fault, SteppingResult& result);

/// A row whose energies do not balance, in words.
std::string unbalanced(const HistoryRow& row);

/// Of each material of a body, mm³, one a row of its laws.
std::vector<double> volumes_of_materials(const Body& body);

/// Energy of a strain so small that rounding is a good part of it, one of 1e-6, over energy_unit. volume: of each
/// material.
double rounding_energy(const std::vector<double>& volume, const PointLaws& laws);

}  // namespace brainshift::solve
