// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// How many times as stiff as softer tissue one is that moves in it nearly as a rigid body.
inline constexpr double nearly_rigid = 30;

/// Parts of tissue thirty times as stiff as others and more, that nothing but these hold, as a hard tumour or a stiff
/// layer in soft tissue: they move nearly as rigid bodies, and slowly. of_point, of_node: µ in Pa of the points and
/// moduli_at_nodes(); rows: at the points; held: one a node, not 0 where something is prescribed. A part hangs together
/// by the points of its tissue. Left out are specks, parts with a node that is held, and one that is most
/// of the body, which moves as that does. Returns the nodes of each part, ascending; the largest parts first.
std::vector<std::vector<std::int32_t>> stiff_parts(std::span<const double> of_point, std::span<const double> of_node,
                                                   const ShapeRows& rows, std::span<const std::uint8_t> held);

}  // namespace brainshift::solve
