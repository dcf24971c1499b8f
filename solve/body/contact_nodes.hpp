// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "segmentation/geometry/signed_distance.hpp"
#include "segmentation/geometry/surface.hpp"
#include "segmentation/geometry/surface_tree.hpp"
#include "solve/body/ordered_cloud.hpp"
#include "solve/boundary/face_contact.hpp"

namespace brainshift::solve {

/// What contact needs of the distance to a skull. It pushes nodes back before they are far out, so it is enough to know
/// it near the skull; but where a free surface node starts farther out. Where nodes are near to each other, as in a
/// small body, its samples are, too. Throws std::invalid_argument on a skull that is no closed surface.
SignedDistance distance_for_contact(const Surface& skull, const OrderedCloud& cloud);

/// Nodes of the surface, and those where sheets of the septum meet, which are on no face of it. One that something else
/// holds in all directions is none; one on a plane of symmetry slides along it.
std::vector<std::int32_t> nodes_at_septum(const Surface& septum, const OrderedCloud& cloud);

/// Whether a place (mm) is on the wall of a cavity. foot: the wall's place nearest to it; spacing: of the nodes, mm.
bool is_on_wall(const SurfacePlace& foot, const Eigen::Vector3d& x, double spacing);

/// Surface nodes on the wall of a cavity.
std::vector<WallNode> nodes_at_wall(const Surface& wall, const OrderedCloud& cloud);

}  // namespace brainshift::solve
