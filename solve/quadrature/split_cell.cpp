// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/split_cell.hpp"

#include <Eigen/Geometry>

namespace brainshift::solve {

namespace {

std::vector<Corners> split_multilinear(const Corners& corners) {
  std::vector<Corners> parts;
  for (int part = 0; part < corners.rows(); ++part) {
    const Eigen::Array3i low(part & 1, (part >> 1) & 1, (part >> 2) & 1);
    Corners of_part(corners.rows(), 3);
    for (int c = 0; c < corners.rows(); ++c) {
      const Eigen::Array3i halves = low + Eigen::Map<const Eigen::Array3i>(vtk_corner[c]);
      of_part.row(c) = place_in(corners, halves.cast<double>() / 2).transpose();
    }
    parts.push_back(of_part);
  }
  return parts;
}

std::vector<Corners> split_triangle(const Corners& c) {
  Corners middle(3, 3);
  middle << (c.row(0) + c.row(1)) / 2, (c.row(1) + c.row(2)) / 2, (c.row(2) + c.row(0)) / 2;
  std::vector<Corners> parts(4, Corners(3, 3));
  parts[0] << c.row(0), middle.row(0), middle.row(2);
  parts[1] << middle.row(0), c.row(1), middle.row(1);
  parts[2] << middle.row(2), middle.row(1), c.row(2);
  parts[3] << middle.row(0), middle.row(1), middle.row(2);
  return parts;
}

double signed_volume(const Corners& c) {
  return (c.row(1) - c.row(0)).cross(c.row(2) - c.row(0)).dot(c.row(3) - c.row(0));
}

/// Four at the corners, and the octahedron between them in four about one of its diagonals.
std::vector<Corners> split_tetrahedron(const Corners& c) {
  const auto middle = [&](int a, int b) -> Eigen::RowVector3d { return (c.row(a) + c.row(b)) / 2; };
  std::vector<Corners> parts;
  const auto add = [&](const Eigen::RowVector3d& p, const Eigen::RowVector3d& q, const Eigen::RowVector3d& r,
                       const Eigen::RowVector3d& s) {
    Corners part(4, 3);
    part << p, q, r, s;
    if (signed_volume(part) * signed_volume(c) < 0) {
      part.row(2).swap(part.row(3));
    }
    parts.push_back(part);
  };
  for (int corner = 0; corner < 4; ++corner) {
    add(c.row(corner), middle(corner, (corner + 1) % 4), middle(corner, (corner + 2) % 4),
        middle(corner, (corner + 3) % 4));
  }
  const Eigen::RowVector3d around[4] = {middle(0, 1), middle(0, 3), middle(2, 3), middle(1, 2)};
  for (int i = 0; i < 4; ++i) {
    add(middle(0, 2), middle(1, 3), around[i], around[(i + 1) % 4]);
  }
  return parts;
}

}  // namespace

std::vector<Corners> split_cell(CellKind kind, const Corners& corners) {
  switch (kind) {
    case CellKind::tetrahedron:
      return split_tetrahedron(corners);
    case CellKind::triangle:
      return split_triangle(corners);
    case CellKind::hexahedron:
    case CellKind::quadrilateral:
      break;
  }
  return split_multilinear(corners);
}

}  // namespace brainshift::solve
