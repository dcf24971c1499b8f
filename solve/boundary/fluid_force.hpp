// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>

#include "segmentation/geometry/points.hpp"
#include "solve/arrays/nodal_vectors.hpp"
#include "solve/interface/model.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/quadrature/point_extents.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// How far the first of the points lies along gravity, mm: their top. points (n × 3), at least one.
double highest(const Eigen::Vector3d& gravity, const Points& points);

/// The level, mm along gravity, when the fluid has drained by a share of the points' height, 0 to 1.
double drained_level(const Eigen::Vector3d& gravity, double share, const Points& points);

/// Adds what the fluid's draining changes, µN, four a node. With g now, g₀ when the image was taken, d = g/|g| and h =
/// level − X·d the height above the level, a tissue gets
///   b = ρ_f g where h > 0, and (ρ − ρ_f)(g − g₀) everywhere:
/// the pressure that has left its surface above the level, ρ_f |g| h, is this force but for a pressure inside, which
/// deforms nothing that keeps its volume (measured on wetted finite elements: tests/verification). Room::drained gets
/// nothing: nothing is in it and nothing on its wall. Room::full gets ρ_f g and the stress ρ_f |g| h of the fluid that
/// still sucks at its wall as in the image: f_a = Σ_I w (φ_a b − ρ_f |g| h ∂φ_a/∂X). A point that the level parts
/// counts by its share above. extents: of the points, along g. rows: with derivatives.
void add_fluid_force(const DrainedFluid& fluid, const std::map<std::int32_t, Material>& materials,
                     const IntegrationPoints& points, const PointExtents& extents, const ShapeRows& rows,
                     NodalVectors& total);

}  // namespace brainshift::solve
