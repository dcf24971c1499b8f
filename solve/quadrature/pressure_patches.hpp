// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/quadrature/integration_points.hpp"

namespace brainshift::solve {

/// Integration points in patches that are compact, of one material and stand for about equally many nodes each.
struct PressurePatches {
  std::vector<std::int32_t> order;  ///< points, patch by patch; patches near in space follow each other
  std::vector<std::int32_t> begin;  ///< (patches + 1) offsets into order

  std::size_t size() const { return begin.size() - 1; }
};

/// Halves each material's points across their longest side until a part stands for nodes_per_patch nodes. share: nodes
/// that each point stands for; material: one a point.
PressurePatches pressure_patches(const Points& positions, std::span<const double> share,
                                 std::span<const std::int32_t> material, double nodes_per_patch);

/// The polynomials of degree 0 and 1 on a patch, orthonormal in Σ_I w_I: values (points × 4) of 1, x, y, z after
/// Gram-Schmidt. One that the points do not tell from those before it, as in a patch of few points or in a plane, is 0.
void pressure_modes(const Points& positions, std::span<const double> volume, std::span<const std::int32_t> points,
                    std::span<double> modes);

}  // namespace brainshift::solve
