// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cells/tetrahedra.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "discretise/cloud/delaunay.hpp"

namespace brainshift::discretise {
namespace {

using Corners = Eigen::Matrix<double, 4, 3>;

/// Volume / cube of the mean edge, relative to a regular tetrahedron; a flatter one is left out.
constexpr double flattest = 1e-4;

Corners corners_of(const Points& nodes, const std::array<std::int32_t, 4>& tetrahedron) {
  Corners x;
  for (std::size_t k = 0; k < 4; ++k) {
    x.row(static_cast<Eigen::Index>(k)) = nodes.row(tetrahedron[k]);
  }
  return x;
}

double volume_of(const Corners& x) {
  const Eigen::Matrix3d edges = x.bottomRows<3>().rowwise() - x.row(0);
  return edges.determinant() / 6;
}

double shape_quality(const Corners& x) {
  double squares = 0;
  for (int a = 0; a < 4; ++a) {
    for (int b = a + 1; b < 4; ++b) {
      squares += (x.row(a) - x.row(b)).squaredNorm();
    }
  }
  return volume_of(x) * 6 * std::sqrt(2.0) / std::pow(squares / 6, 1.5);
}

/// More than half of twenty places spread evenly in it lie in the body.
bool mostly_inside(const Corners& x, const Scanlines& body) {
  int inside = 0;
  int looked = 0;
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; a + b < 4; ++b) {
      for (int c = 0; a + b + c < 4; ++c) {
        const Eigen::RowVector4d weight(a + 0.25, b + 0.25, c + 0.25, 3 - a - b - c + 0.25);
        inside += body.inside((weight / 4 * x).transpose()) ? 1 : 0;
        ++looked;
      }
    }
  }
  return 2 * inside > looked;
}

}  // namespace

BackgroundCells inside_tetrahedra(const Points& nodes, const Scanlines& body, const TissueLookup& tissue) {
  const auto tetrahedra = delaunay_tetrahedra(nodes);
  std::vector<std::int32_t> label(tetrahedra.size());
  std::vector<std::uint8_t> kept(tetrahedra.size());
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    const Corners x = corners_of(nodes, tetrahedra[t]);
    kept[t] = shape_quality(x) > flattest && mostly_inside(x, body) ? 1 : 0;
    label[t] = kept[t] != 0 ? tissue.tissue_at(x.colwise().mean().transpose()) : 0;
  }
  BackgroundCells cells;
  cells.kind = CellKind::tetrahedron;
  cells.vertices = nodes;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    if (kept[t] != 0) {
      cells.connectivity.insert(cells.connectivity.end(), tetrahedra[t].begin(), tetrahedra[t].end());
      cells.label.push_back(label[t]);
    }
  }
  cells.inside_fraction.assign(cells.label.size(), 1.0);
  return cells;
}

double inside_volume(const BackgroundCells& cells) {
  const auto corners = static_cast<std::size_t>(cells.corners());
  double total = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const std::int32_t* const corner = cells.connectivity.data() + cell * corners;
    const bool hexahedron = cells.kind == CellKind::hexahedron;
    const int along[3] = {1, hexahedron ? 3 : 2, hexahedron ? 4 : 3};
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) {
      edges.row(k) = cells.vertices.row(corner[along[k]]) - cells.vertices.row(corner[0]);
    }
    total += cells.inside_fraction[cell] * edges.determinant() / (hexahedron ? 1 : 6);
  }
  return total;
}

}  // namespace brainshift::discretise
