// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/gauss_points.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace brainshift::solve {

namespace {

constexpr double thickness = 1;  // of planar cells, mm

/// Trilinear map of the hexahedron (VTK's corner order) at local coordinates in [-1, 1]³, and its volume ratio.
WeightedPoint hexahedron_point(const Corners& corners, const Eigen::Vector3d& xi, double weight) {
  constexpr std::array<std::array<double, 3>, 8> sign = {
      {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 8; ++i) {
    const auto& s = sign[static_cast<std::size_t>(i)];
    const Eigen::Vector3d factor(1 + s[0] * xi[0], 1 + s[1] * xi[1], 1 + s[2] * xi[2]);
    const Eigen::Vector3d corner = corners.row(i);
    x += factor.prod() / 8 * corner;
    jacobian +=
        corner / 8 *
        Eigen::RowVector3d(s[0] * factor[1] * factor[2], s[1] * factor[0] * factor[2], s[2] * factor[0] * factor[1]);
  }
  return {x, weight * jacobian.determinant()};
}

void whole_hexahedron(const Corners& corners, int points, std::vector<WeightedPoint>& out) {
  if (points == 1) {
    out.push_back(hexahedron_point(corners, Eigen::Vector3d::Zero(), 8.0));
    return;
  }
  const double g = 1 / std::sqrt(3.0);
  for (int octant = 0; octant < 8; ++octant) {
    const Eigen::Vector3d xi((octant & 1) ? g : -g, (octant & 2) ? g : -g, (octant & 4) ? g : -g);
    out.push_back(hexahedron_point(corners, xi, 1.0));
  }
}

void whole_tetrahedron(const Corners& corners, int points, std::vector<WeightedPoint>& out) {
  const Eigen::Vector3d centre = corners.colwise().mean();
  const Eigen::Matrix3d edges = corners.bottomRows<3>().rowwise() - corners.row(0);
  const double volume = edges.determinant() / 6;
  if (points == 1) {
    out.push_back({centre, volume});
    return;
  }
  const double towards_corner = 1 / std::sqrt(5.0);  // barycentric (5 + 3√5)/20 and (5 − √5)/20: exact for quadratics
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d corner = corners.row(i);
    out.push_back({centre + towards_corner * (corner - centre), volume / 4});
  }
}

/// Bilinear map of the quadrilateral (VTK's corner order) at local coordinates in [-1, 1]², and its area ratio.
WeightedPoint quadrilateral_point(const Corners& corners, double xi, double eta, double weight) {
  constexpr double sign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Matrix2d jacobian = Eigen::Matrix2d::Zero();
  for (int i = 0; i < 4; ++i) {
    const double along = 1 + sign[i][0] * xi;
    const double across = 1 + sign[i][1] * eta;
    const Eigen::Vector3d corner = corners.row(i);
    x += along * across / 4 * corner;
    jacobian += corner.head<2>() / 4 * Eigen::RowVector2d(sign[i][0] * across, sign[i][1] * along);
  }
  return {x, weight * jacobian.determinant() * thickness};
}

void whole_quadrilateral(const Corners& corners, int points, std::vector<WeightedPoint>& out) {
  if (points == 1) {
    out.push_back(quadrilateral_point(corners, 0, 0, 4.0));
    return;
  }
  const double g = 1 / std::sqrt(3.0);
  for (int quadrant = 0; quadrant < 4; ++quadrant) {
    out.push_back(quadrilateral_point(corners, (quadrant & 1) ? g : -g, (quadrant & 2) ? g : -g, 1.0));
  }
}

void whole_triangle(const Corners& corners, int points, std::vector<WeightedPoint>& out) {
  const Eigen::Vector3d centre = corners.colwise().mean();
  const Eigen::Matrix<double, 2, 3> edges = corners.bottomRows<2>().rowwise() - corners.row(0);
  const double volume = edges.leftCols<2>().determinant() / 2 * thickness;
  if (points == 1) {
    out.push_back({centre, volume});
    return;
  }
  for (int i = 0; i < 3; ++i) {  // barycentric 2/3 and 1/6: exact for quadratics
    const Eigen::Vector3d corner = corners.row(i);
    out.push_back({(corner + centre) / 2, volume / 3});
  }
}

}  // namespace

Corners corners_of(const BackgroundCells& cells, std::size_t cell) {
  const int n = cells.corners();
  Corners corners(n, 3);
  for (int i = 0; i < n; ++i) {
    corners.row(i) =
        cells.vertices.row(cells.connectivity[cell * static_cast<std::size_t>(n) + static_cast<std::size_t>(i)]);
  }
  return corners;
}

Eigen::Vector3d place_in(const Corners& corners, const Eigen::Array3d& local) {
  const int axes = corners.rows() == 8 ? 3 : 2;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (int k = 0; k < corners.rows(); ++k) {
    double weight = 1;
    for (int axis = 0; axis < axes; ++axis) {
      weight *= vtk_corner[k][axis] == 1 ? local[axis] : 1 - local[axis];
    }
    x += weight * corners.row(k).transpose();
  }
  return x;
}

WeightedPoint inside_point(const InsideOctants& part) {
  WeightedPoint whole{Eigen::Vector3d::Zero(), 0};
  for (int octant = 0; octant < 8; ++octant) {
    if (part.volume[octant] > 0) {
      whole.position += part.volume[octant] * Eigen::Vector3d(part.centroid[octant]);
      whole.volume += part.volume[octant];
    }
  }
  whole.position /= whole.volume;
  return whole;
}

void gauss_points(CellKind kind, const Corners& corners, int points, std::vector<WeightedPoint>& out) {
  switch (kind) {
    case CellKind::hexahedron:
      return whole_hexahedron(corners, points, out);
    case CellKind::tetrahedron:
      return whole_tetrahedron(corners, points, out);
    case CellKind::quadrilateral:
      return whole_quadrilateral(corners, points, out);
    case CellKind::triangle:
      return whole_triangle(corners, points, out);
  }
}

}  // namespace brainshift::solve
