// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "segmentation/image/image.hpp"
#include "solve/interface/solution.hpp"

namespace brainshift::registration {

/// Looks values that are known at nodes (n × k) up at points (m × 3): m × k, as nodal_values_at().
using NodalLookUp = std::function<Eigen::MatrixXd(const Points& points)>;
NodalLookUp nodal_look_up(const Solution& solution, Eigen::MatrixXd values, bool moved, double outside = 0);

/// Values that are known at the solution's nodes (n × k), at points (m × 3, mm, LPS) of the preop or, with `moved`, the
/// intraop brain: m × k, weights 1 / distance² over the eight nearest nodes. `outside` at a point farther than the
/// spacing from every node, as nothing is known there.
Eigen::MatrixXd nodal_values_at(const Solution& solution, const Eigen::MatrixXd& values, bool moved,
                                const Points& points, double outside = 0);

/// The same of one value a node, at the voxels of a grid; 0 where nothing is known: farther from every node than the
/// spacing, and than the diagonal of a voxel of grid_around_nodes(), so that hardly any 0 counts in the brain where
/// such voxels are interpolated.
ScalarImage nodal_values_on(const Solution& solution, const std::vector<double>& values, bool moved,
                            const ImageGeometry& grid);

/// The same of the solution's estimated error, mm, at points of the preop brain; NaN outside. The solution must have an
/// estimate.
std::vector<double> estimated_error_at(const Solution& solution, const Points& points);

/// A grid around the nodes of the preop or, with `moved`, the intraop brain: voxels of 4 mm along the axes of LPS.
ImageGeometry grid_around_nodes(const Solution& solution, bool moved);

}  // namespace brainshift::registration
