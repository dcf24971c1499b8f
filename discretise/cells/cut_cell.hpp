// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "discretise/body/scanlines.hpp"
#include "discretise/interface/background_cells.hpp"

namespace brainshift::discretise {

/// The inside part of a box.
struct InsidePart {
  double volume = 0;  ///< mm³
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  InsideOctants octants{};
};

/// Integrates the inside part of the cube at `low` along lines. Centroids that fall outside the body (a concave part)
/// move to the nearest inside place found. A negligible octant's volume joins the largest.
InsidePart inside_part(const Scanlines& body, const Eigen::Vector3d& low, double edge);

}  // namespace brainshift::discretise
