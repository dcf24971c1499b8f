// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "discretise/interface/background_cells.hpp"

namespace brainshift::solve {

/// One row a corner, in VTK's order, mm.
using Corners = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor, 8, 3>;

struct WeightedPoint {
  Eigen::Vector3d position;  ///< mm
  double volume;             ///< mm³
};

Corners corners_of(const BackgroundCells& cells, std::size_t cell);

/// The place of a hexahedron or quadrilateral at local coordinates in [0, 1] along its edges, by its multilinear map.
Eigen::Vector3d place_in(const Corners& corners, const Eigen::Array3d& local);

/// The centroid of the inside part of a cut cell, with its volume.
WeightedPoint inside_point(const InsideOctants& part);

/// Appends the Gauss points of a whole cell: 1, or what integrates quadratics exactly (8 a hexahedron, 4 a tetrahedron
/// or quadrilateral, 3 a triangle). Planar cells count as 1 mm thick.
void gauss_points(CellKind kind, const Corners& corners, int points, std::vector<WeightedPoint>& out);

}  // namespace brainshift::solve
