// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/interface/background_cells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>

#include "segmentation/geometry/plane.hpp"

namespace brainshift {
namespace {

[[noreturn]] void refuse_cell(std::size_t cell, const std::string& why) {
  throw std::invalid_argument("cell " + std::to_string(cell) + " " + why);
}

/// The corners that edges lead to from each corner of a cell (VTK order), right-handed; from one corner where the
/// others say the same.
constexpr int hexahedron_edges[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                        {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
constexpr int tetrahedron_edges[1][3] = {{1, 2, 3}};
constexpr int quadrilateral_edges[4][2] = {{1, 3}, {2, 0}, {3, 1}, {0, 2}};
constexpr int triangle_edges[1][2] = {{1, 2}};

/// The least, over the corners, of the volume (area) spanned by the edges there relative to the cube (square) of the
/// longest of them: not positive for an inverted or flat cell.
template <int dimensions, std::size_t corners>
double worst_corner(const Points& vertices, const std::int32_t* cell, const int (&ends)[corners][dimensions]) {
  double worst = 1;
  for (std::size_t corner = 0; corner < corners; ++corner) {
    Eigen::Matrix<double, dimensions, dimensions> edges;
    for (int k = 0; k < dimensions; ++k) {
      const Eigen::RowVector3d edge = vertices.row(cell[ends[corner][k]]) - vertices.row(cell[corner]);
      edges.row(k) = edge.head<dimensions>();
    }
    const double longest = std::sqrt(edges.rowwise().squaredNorm().maxCoeff());
    worst = std::min(worst, longest > 0 ? edges.determinant() / std::pow(longest, dimensions) : 0);
  }
  return worst;
}

double worst_corner(const Points& vertices, const std::int32_t* cell, CellKind kind) {
  switch (kind) {
    case CellKind::hexahedron:
      return worst_corner(vertices, cell, hexahedron_edges);
    case CellKind::tetrahedron:
      return worst_corner(vertices, cell, tetrahedron_edges);
    case CellKind::quadrilateral:
      return worst_corner(vertices, cell, quadrilateral_edges);
    case CellKind::triangle:
      return worst_corner(vertices, cell, triangle_edges);
  }
  return 0;
}

/// Of a hexahedron, by the six tetrahedra around its diagonal from corner 0 to corner 6.
double hexahedron_volume(const Points& vertices, const std::int32_t* cell) {
  constexpr int around[6] = {1, 2, 3, 7, 4, 5};
  const Eigen::RowVector3d diagonal = vertices.row(cell[6]) - vertices.row(cell[0]);
  double volume = 0;
  for (int k = 0; k < 6; ++k) {
    const Eigen::RowVector3d a = vertices.row(cell[around[k]]) - vertices.row(cell[0]);
    const Eigen::RowVector3d b = vertices.row(cell[around[(k + 1) % 6]]) - vertices.row(cell[0]);
    volume += a.cross(b).dot(diagonal) / 6;
  }
  return std::abs(volume);
}

/// Whether a cell is neither inverted nor flat. Corners of a hexahedron may meet, as those of a wedge do.
bool is_sound(const Points& vertices, const std::int32_t* cell, CellKind kind) {
  constexpr double nothing = 1e-12;
  const double worst = worst_corner(vertices, cell, kind);
  if (kind != CellKind::hexahedron) {
    return worst > nothing;
  }
  const double across = (vertices.row(cell[6]) - vertices.row(cell[0])).norm();
  return worst > -nothing && hexahedron_volume(vertices, cell) > nothing * std::pow(across, 3);
}

/// The inside part must be one of its cell: the points that it gives carry its volume.
void check_cut_part(const BackgroundCells& cells, std::size_t cell, const InsideOctants& part) {
  const std::int32_t* corners = cells.connectivity.data() + 8 * cell;
  Eigen::Array3d low = cells.vertices.row(corners[0]), high = low;
  for (int k = 1; k < 8; ++k) {
    const Eigen::Array3d corner = cells.vertices.row(corners[k]);
    low = low.min(corner);
    high = high.max(corner);
  }
  const Eigen::Array3d slack = 1e-3 * (high - low);
  for (int octant = 0; octant < 8; ++octant) {
    const Eigen::Array3d centroid = Eigen::Map<const Eigen::Array3d>(part.centroid[octant]);
    const double volume = part.volume[octant];
    if (!(volume >= 0 && std::isfinite(volume)) || (volume > 0 && !centroid.isFinite().all())) {
      refuse_cell(cell, "has an octant with a negative volume or a number that is not finite.");
    }
    if (volume > 0 && !((centroid >= low - slack).all() && (centroid <= high + slack).all())) {
      throw std::invalid_argument("octant " + std::to_string(octant) + " of cell " + std::to_string(cell) +
                                  " has its centroid outside the cell.");
    }
  }
  const double volume = hexahedron_volume(cells.vertices, corners);
  const double inside = std::accumulate(std::begin(part.volume), std::end(part.volume), 0.0);
  if (inside > 1.001 * volume) {
    throw std::invalid_argument("the octants of cell " + std::to_string(cell) + " hold " + std::to_string(inside) +
                                " mm³, more than the cell (" + std::to_string(volume) + " mm³).");
  }
}

void check_lengths(const BackgroundCells& cells) {
  const std::size_t count = cells.size(), corners = static_cast<std::size_t>(cells.corners());
  if (count == 0) {
    throw std::invalid_argument("there is no background cell.");
  }
  if (cells.connectivity.size() != corners * count || cells.label.size() != count ||
      (!cells.cut_index.empty() && cells.cut_index.size() != count)) {
    throw std::invalid_argument("of " + std::to_string(count) + " background cells connectivity has " +
                                std::to_string(cells.connectivity.size()) + " entries, label " +
                                std::to_string(cells.label.size()) + " and cut_index " +
                                std::to_string(cells.cut_index.size()) + "; " + std::to_string(corners) +
                                ", 1 and 1 (or none) a cell are expected.");
  }
  if (!cells.vertices.allFinite()) {
    throw std::invalid_argument("a vertex of the background cells is not finite.");
  }
  if (is_planar(cells.kind)) {
    if (const auto fault = off_plane(cells.vertices, "vertex")) {
      throw std::invalid_argument(*fault);
    }
  }
}

void check_cell(const BackgroundCells& cells, std::size_t cell) {
  const auto corners = static_cast<std::size_t>(cells.corners());
  const std::int32_t* const first = cells.connectivity.data() + cell * corners;
  const auto is_vertex = [&](std::int32_t v) { return v >= 0 && v < cells.vertices.rows(); };
  if (!std::all_of(first, first + corners, is_vertex)) {
    refuse_cell(cell, "has a corner that is no vertex.");
  }
  if (!is_sound(cells.vertices, first, cells.kind)) {
    refuse_cell(cell, is_planar(cells.kind)
                          ? "is clockwise, not convex or flat; its corners go counter-clockwise about z."
                          : "is inverted or flat.");
  }
  const double fraction = cells.inside_fraction[cell];
  if (!(fraction > 0 && fraction <= 1)) {
    refuse_cell(cell, "has inside_fraction " + std::to_string(fraction) + "; above 0 and at most 1 is expected.");
  }
  const std::int32_t cut = cells.cut_index.empty() ? -1 : cells.cut_index[cell];
  if (cut >= static_cast<std::int32_t>(cells.cut_parts.size())) {
    refuse_cell(cell, "has a cut_index that is none of the cut parts.");
  }
  if (cut >= 0 && cells.kind != CellKind::hexahedron) {
    refuse_cell(cell, "has octants, which hexahedra alone have.");
  }
  if (cut >= 0) {
    check_cut_part(cells, cell, cells.cut_parts[static_cast<std::size_t>(cut)]);
  }
}

/// A cell that is there twice counts twice, unless these are two parts of it, as on the sides of a wall.
void check_distinct(const BackgroundCells& cells) {
  const auto corners = static_cast<std::size_t>(cells.corners());
  std::vector<Eigen::Vector3d> sum(cells.size(), Eigen::Vector3d::Zero());
  std::vector<double> along(corners);
  for (std::size_t i = 0; i < 3 * cells.size(); ++i) {  // in one order, whichever corner is the first
    const auto axis = static_cast<Eigen::Index>(i % 3);
    for (std::size_t k = 0; k < corners; ++k) {
      along[k] = cells.vertices(cells.connectivity[i / 3 * corners + k], axis);
    }
    std::sort(along.begin(), along.end());
    sum[i / 3][axis] = std::accumulate(along.begin(), along.end(), 0.0);
  }
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t cell) { return std::tuple(sum[cell].x(), sum[cell].y(), sum[cell].z(), cell); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  constexpr double whole = 1.001;
  double inside = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && sum[order[i]] == sum[order[i - 1]];
    inside = (same ? inside : 0) + cells.inside_fraction[order[i]];
    if (inside > whole) {
      throw std::invalid_argument("cells " + std::to_string(order[i - 1]) + " and " + std::to_string(order[i]) +
                                  " are in one place and together more than it holds; remove one of them.");
    }
  }
}

}  // namespace

void check_cells(const BackgroundCells& cells) {
  check_lengths(cells);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    check_cell(cells, cell);
  }
  check_distinct(cells);
}

}  // namespace brainshift
