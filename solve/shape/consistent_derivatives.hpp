// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "segmentation/geometry/points.hpp"
#include "solve/shape/shape_functions.hpp"
#include "solve/shape/surface_normals.hpp"

namespace brainshift::solve {

/// What the correction did.
struct ConsistencyMeasures {
  int iterations = 0;
  double defect_before = 0;  ///< largest |Σ_I w B_a| that surface forces do not balance, over the mean of Σ_I w |B_a|
  double defect_after = 0;
};

/// Changes the derivatives B_a(X_I) at integration points as little as possible, in Σ_I w |δB|², so that a body under
/// constant stress is in equilibrium with forces at the surface nodes alone, whatever the background cells:
///   Σ_I w B_a = Σ_s V_sa g_s, V the shape functions at the surface nodes s, g_s an area vector along the normals
///   there,
/// while every point keeps reproducing linear fields, Σ_a B_a = 0 and Σ_a B_a ⊗ X_a = 1. It is what the divergence
/// theorem asks for and background cells that do not conform violate. Homogeneous states under prescribed
/// displacements, free faces and planes of symmetry are then exact to the tolerance. The idea is variational
/// consistency (Chen, Hillman & Rüter 2013), but with the same derivatives for test and trial functions: forces stay
/// the gradient of an energy, and a time step costs nothing more.
///
/// One sparse system in the nodes by conjugate gradients. positions: of the nodes; surface: the nodes that may carry
/// forces; nodal_rows: shape functions at all nodes; volume: one an integration point. part: the points whose
/// derivatives may change, as where a cut goes on; empty: all. normals: at the surface nodes; absent: g_s may have any
/// direction, and only states are exact in which all of the surface is prescribed. Throws std::invalid_argument when no
/// node is on the surface.
ConsistencyMeasures make_derivatives_consistent(const Points& positions, std::span<const std::int32_t> surface,
                                                const ShapeRows& nodal_rows, std::span<const double> volume,
                                                double tolerance, ShapeRows& rows,
                                                std::span<const std::int32_t> part = {},
                                                const SurfaceNormals* normals = nullptr);

}  // namespace brainshift::solve
