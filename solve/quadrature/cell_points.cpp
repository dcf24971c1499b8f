// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/cell_points.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "solve/quadrature/gauss_points.hpp"
#include "solve/quadrature/merge_slivers.hpp"
#include "solve/quadrature/place_points.hpp"
#include "solve/quadrature/tissue_shares.hpp"

namespace brainshift::solve {

namespace {

void cut_cell(const InsideOctants& part, int points, std::vector<WeightedPoint>& out) {
  if (points == 1) {
    out.push_back(inside_point(part));
    return;
  }
  for (std::size_t octant = 0; octant < 8; ++octant) {
    if (part.volume[octant] > 0) {
      out.push_back({Eigen::Vector3d(part.centroid[octant]), part.volume[octant]});
    }
  }
}

/// full: the mean volume of the points of the cell uncut.
void append_points(const BackgroundCells& cells, std::size_t cell, int points, std::vector<WeightedPoint>& out,
                   std::vector<double>& full) {
  const std::int32_t cut = cells.cut_index.empty() ? -1 : cells.cut_index[cell];
  const std::size_t first = out.size();
  gauss_points(cells.kind, corners_of(cells, cell), points, out);
  double whole = 0;
  for (std::size_t i = first; i < out.size(); ++i) {
    whole += out[i].volume / points;
    out[i].volume *= cells.inside_fraction[cell];
  }
  if (cut >= 0) {
    out.resize(first);
    cut_cell(cells.cut_parts[static_cast<std::size_t>(cut)], points, out);
  }
  full.resize(out.size(), whole);
}

}  // namespace

int most_points_per_cell(CellKind kind) {
  return kind == CellKind::hexahedron ? 8 : kind == CellKind::triangle ? 3 : 4;
}

int points_per_cell(std::optional<int> asked, CellKind kind, bool adaptive) {
  return asked.value_or(adaptive ? 1 : most_points_per_cell(kind));
}

void check_points_per_cell(CellKind kind, int points) {
  const int many = most_points_per_cell(kind);
  if (points != 1 && points != many) {
    constexpr std::array<const char*, 4> names = {"hexahedra", "tetrahedra", "quadrilaterals", "triangles"};
    throw std::invalid_argument("points_per_cell is " + std::to_string(points) + ", but " +
                                names[static_cast<std::size_t>(kind)] + " take 1 or " + std::to_string(many));
  }
}

void take_tissues(const BackgroundCells& cells, const LabelMap* labels, const std::vector<std::int32_t>& tissues,
                  IntegrationPoints& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::int32_t at_point =
        labels ? label_at(*labels, points.positions.row(static_cast<Eigen::Index>(i)).transpose()) : 0;
    const bool known = at_point != 0 && std::find(tissues.begin(), tissues.end(), at_point) != tissues.end();
    points.labelled_by_cell += labels && !known ? 1 : 0;
    points.label.push_back(known ? at_point : cells.label[static_cast<std::size_t>(points.cell[i])]);
  }
}

IntegrationPoints integration_points(const BackgroundCells& cells, int points_per_cell, const LabelMap* labels,
                                     const std::vector<std::int32_t>& tissues) {
  check_points_per_cell(cells.kind, points_per_cell);
  std::vector<WeightedPoint> points;
  std::vector<double> full;
  IntegrationPoints result;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    append_points(cells, cell, points_per_cell, points, full);
    result.cell.resize(points.size(), static_cast<std::int32_t>(cell));
  }
  place_points(points, result);
  take_tissues(cells, labels, tissues, result);
  if (labels != nullptr) {
    part_by_tissue(cells, *labels, tissues, result, full);
  }
  merge_slivers(full, result);
  return result;
}

}  // namespace brainshift::solve
