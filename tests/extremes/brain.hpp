// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/extremes/row.hpp"

namespace brainshift::extremes {

/// A real brain's surface filled with nodes: its base is held, the top sinks by `sink` mm, the rest is free.
solve::Model brain_model(std::size_t nodes, double sink);

/// Largest |u − wanted| over the nodes, mm.
double largest_difference(const Points& u, const Points& wanted);

}  // namespace brainshift::extremes
