// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/discretise.hpp"
#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::test {

/// A ball, its vertices on the sphere: an octahedron whose triangles are split in four `splits` times.
Surface ball(double radius, const Eigen::Vector3d& centre, int splits);

/// Ellipsoid of 160 × 130 × 120 mm with bumps and dents, far from the origin: a stand-in for a brain.
Surface bumpy_brain();

/// Labels in an oblique, left-handed frame of 1 mm voxels around `centre`: tissue 3 within `inner` of it, 1 within
/// `outer`, else 0.
LabelMap ball_labels(const Eigen::Vector3d& centre, double inner, double outer);

/// A surface filled with about so many nodes, all of one tissue.
discretise::Discretisation with_nodes(const Surface& surface, std::size_t nodes, CellKind kind = CellKind::hexahedron);

}  // namespace brainshift::test
