// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/point_extents.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "solve/quadrature/gauss_points.hpp"

namespace brainshift::solve {
namespace {

/// The variance of a place in a cell over that of its corners, along any direction: exact for parallelepipeds and
/// simplices.
double share_of_corners_variance(CellKind kind) {
  switch (kind) {
    case CellKind::hexahedron:
    case CellKind::quadrilateral:
      return 1.0 / 3;
    case CellKind::tetrahedron:
      return 1.0 / 5;
    case CellKind::triangle:
      return 1.0 / 4;
  }
  return 0;
}

struct CellAlong {
  double volume;    ///< mm³
  double variance;  ///< mm²
};

CellAlong cell_along(const Eigen::Vector3d& direction, const BackgroundCells& cells, std::size_t cell) {
  const Corners corners = corners_of(cells, cell);
  const Eigen::VectorXd along = corners * direction;
  std::vector<WeightedPoint> middle;
  gauss_points(cells.kind, corners, 1, middle);
  const double of_corners = (along.array() - along.mean()).square().mean();
  return {middle.front().volume, share_of_corners_variance(cells.kind) * of_corners};
}

/// Moves the middles of a whole cell's points, of these volumes, towards that of all by the same factor, after which
/// they and the boxes about them have the cell's variance.
void move_inwards(double variance, std::span<const double> volume, std::span<const double> edge,
                  std::span<double> middle) {
  double all = 0, mean = 0, of_middles = 0, of_boxes = 0;
  for (std::size_t i = 0; i < volume.size(); ++i) {
    all += volume[i];
    mean += volume[i] * middle[i];
  }
  mean /= all;
  for (std::size_t i = 0; i < volume.size(); ++i) {
    of_middles += volume[i] / all * std::pow(middle[i] - mean, 2);
    of_boxes += volume[i] / all * edge[i] * edge[i] / 12;
  }
  const double left = std::max(0.0, variance - of_boxes);
  const double factor = left < of_middles ? std::sqrt(left / of_middles) : 1;
  for (double& m : middle) {
    m = mean + factor * (m - mean);
  }
}

}  // namespace

PointExtents extents_along(const Eigen::Vector3d& direction, const BackgroundCells& cells,
                           const IntegrationPoints& points) {
  const Eigen::VectorXd along = points.positions * direction;
  PointExtents extents{{along.begin(), along.end()}, std::vector<double>(points.size())};
  const double dimensions = is_planar(cells.kind) ? 2 : 3;
  for (std::size_t first = 0, next = 0; first < points.size(); first = next) {
    const CellAlong cell = cell_along(direction, cells, static_cast<std::size_t>(points.cell[first]));
    double filled = 0;
    for (; next < points.size() && points.cell[next] == points.cell[first]; ++next) {
      filled += points.volume[next];
      extents.edge[next] = std::sqrt(12 * cell.variance) * std::pow(points.volume[next] / cell.volume, 1 / dimensions);
    }
    if (filled > (1 - 1e-6) * cell.volume) {
      move_inwards(cell.variance, std::span(points.volume).subspan(first, next - first),
                   std::span(extents.edge).subspan(first, next - first),
                   std::span(extents.middle).subspan(first, next - first));
    }
  }
  return extents;
}

}  // namespace brainshift::solve
