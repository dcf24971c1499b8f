// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <random>

#include "discretise/interface/background_cells.hpp"
#include "discretise/interface/node_cloud.hpp"

namespace brainshift::test {

/// A box of n × n × n nodes, the inner ones moved at random by up to `jitter` of the spacing.
inline NodeCloud irregular_box(int n, double side, double jitter = 0.25, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(-jitter, jitter);
  NodeCloud cloud;
  const double h = side / (n - 1);
  cloud.positions.resize(static_cast<Eigen::Index>(n) * n * n, 3);
  Eigen::Index row = 0;
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i, ++row) {
        Eigen::RowVector3d x(i, j, k);
        bool surface = false;
        for (int axis = 0; axis < 3; ++axis) {
          const bool at_face = x[axis] < 0.5 || x[axis] > n - 1.5;
          surface = surface || at_face;
          x[axis] += at_face ? 0.0 : within(random);
        }
        cloud.positions.row(row) = h * x;
        cloud.on_surface.push_back(surface ? 1 : 0);
      }
    }
  }
  cloud.spacing.assign(cloud.on_surface.size(), h);
  return cloud;
}

/// Regular hexahedra over the box from the origin to `size`, `count` along each axis.
inline BackgroundCells box_cells(const Eigen::Vector3i& count, const Eigen::Vector3d& size) {
  BackgroundCells cells;
  const auto vertex = [&](int i, int j, int k) { return (k * (count[1] + 1) + j) * (count[0] + 1) + i; };
  cells.vertices.resize(static_cast<Eigen::Index>(count[0] + 1) * (count[1] + 1) * (count[2] + 1), 3);
  for (int k = 0; k <= count[2]; ++k) {
    for (int j = 0; j <= count[1]; ++j) {
      for (int i = 0; i <= count[0]; ++i) {
        cells.vertices.row(vertex(i, j, k)) = Eigen::Array3d(i, j, k) / count.cast<double>().array() * size.array();
        if (i < count[0] && j < count[1] && k < count[2]) {
          cells.connectivity.insert(
              cells.connectivity.end(),
              {vertex(i, j, k), vertex(i + 1, j, k), vertex(i + 1, j + 1, k), vertex(i, j + 1, k), vertex(i, j, k + 1),
               vertex(i + 1, j, k + 1), vertex(i + 1, j + 1, k + 1), vertex(i, j + 1, k + 1)});
        }
      }
    }
  }
  cells.inside_fraction.assign(cells.connectivity.size() / 8, 1.0);
  cells.label.assign(cells.inside_fraction.size(), 1);
  return cells;
}

/// The same over a cube.
inline BackgroundCells box_cells(int n, double side) {
  return box_cells(Eigen::Vector3i::Constant(n), Eigen::Vector3d::Constant(side));
}

/// Gives each hexahedron the label that label_at says of its lowest corner, (x, y, z) mm.
template <class LabelAt>
void label_cells(BackgroundCells& cells, const LabelAt& label_at) {
  for (std::size_t c = 0; c < cells.size(); ++c) {
    cells.label[c] = label_at(Eigen::RowVector3d(cells.vertices.row(cells.connectivity[8 * c])));
  }
}

/// Tetrahedra whose vertices are the nodes of irregular_box(n): six a cube (Kuhn's division), conforming.
inline BackgroundCells box_tetrahedra(const NodeCloud& cloud, int n) {
  BackgroundCells cells;
  cells.kind = CellKind::tetrahedron;
  cells.vertices = cloud.positions;
  const int step[3] = {1, n, n * n};
  const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int k = 0; k + 1 < n; ++k) {
    for (int j = 0; j + 1 < n; ++j) {
      for (int i = 0; i + 1 < n; ++i) {
        for (int o = 0; o < 6; ++o) {
          const int a = (k * n + j) * n + i;
          const int b = a + step[orders[o][0]];
          const int c = b + step[orders[o][1]];
          const int d = c + step[orders[o][2]];
          const bool even = o < 3;
          cells.connectivity.insert(cells.connectivity.end(), {a, b, even ? c : d, even ? d : c});
        }
      }
    }
  }
  cells.inside_fraction.assign(cells.connectivity.size() / 4, 1.0);
  cells.label.assign(cells.inside_fraction.size(), 1);
  return cells;
}

/// A rectangle of nx × ny nodes with z = 0, the inner ones moved at random by up to `jitter` of the spacing.
inline NodeCloud irregular_rectangle(int nx, int ny, double width, double height, double jitter = 0.25,
                                     unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(-jitter, jitter);
  NodeCloud cloud;
  const double hx = width / (nx - 1), hy = height / (ny - 1);
  cloud.positions.resize(static_cast<Eigen::Index>(nx) * ny, 3);
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const bool x_end = i == 0 || i == nx - 1, y_end = j == 0 || j == ny - 1;
      const double x = i + (x_end ? 0.0 : within(random)), y = j + (y_end ? 0.0 : within(random));
      cloud.positions.row(j * nx + i) << hx * x, hy * y, 0;
      cloud.on_surface.push_back(x_end || y_end ? 1 : 0);
    }
  }
  cloud.spacing.assign(cloud.on_surface.size(), std::max(hx, hy));
  return cloud;
}

/// nx × ny quadrilaterals over a rectangle.
inline BackgroundCells rectangle_cells(int nx, int ny, double width, double height) {
  BackgroundCells cells;
  cells.kind = CellKind::quadrilateral;
  const auto vertex = [nx](int i, int j) { return j * (nx + 1) + i; };
  cells.vertices.resize(static_cast<Eigen::Index>(nx + 1) * (ny + 1), 3);
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      cells.vertices.row(vertex(i, j)) << width / nx * i, height / ny * j, 0;
      if (i < nx && j < ny) {
        cells.connectivity.insert(cells.connectivity.end(),
                                  {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
    }
  }
  cells.inside_fraction.assign(cells.connectivity.size() / 4, 1.0);
  cells.label.assign(cells.inside_fraction.size(), 1);
  return cells;
}

/// Triangles whose vertices are the nodes of irregular_rectangle(nx, ny): two a rectangle, conforming.
inline BackgroundCells rectangle_triangles(const NodeCloud& cloud, int nx, int ny) {
  BackgroundCells cells;
  cells.kind = CellKind::triangle;
  cells.vertices = cloud.positions;
  for (int j = 0; j + 1 < ny; ++j) {
    for (int i = 0; i + 1 < nx; ++i) {
      const int a = j * nx + i, b = a + 1, c = b + nx, d = a + nx;
      cells.connectivity.insert(cells.connectivity.end(), {a, b, c, a, c, d});
    }
  }
  cells.inside_fraction.assign(cells.connectivity.size() / 3, 1.0);
  cells.label.assign(cells.inside_fraction.size(), 1);
  return cells;
}

/// Points inside the box, at random.
inline Points random_points(int count, double side, unsigned seed = 7) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(0, side);
  Points points(count, 3);
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    points.data()[i] = within(random);
  }
  return points;
}

}  // namespace brainshift::test
