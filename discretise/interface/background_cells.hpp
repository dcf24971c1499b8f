// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift {

enum class CellKind : std::uint8_t { hexahedron, tetrahedron, quadrilateral, triangle };

/// Whether cells of this kind are those of a planar problem: all of it lies in the plane z = 0.
constexpr bool is_planar(CellKind kind) {
  return kind == CellKind::quadrilateral || kind == CellKind::triangle;
}

/// Vertices of a cell.
constexpr int corner_count(CellKind kind) {
  switch (kind) {
    case CellKind::hexahedron:
      return 8;
    case CellKind::tetrahedron:
    case CellKind::quadrilateral:
      return 4;
    case CellKind::triangle:
      return 3;
  }
  return 0;
}

/// Where the corners of a hexahedron lie along its edges, 0 or 1, in VTK's order; the first four are a quadrilateral's.
inline constexpr int vtk_corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                         {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

/// The part of a cut cell that lies inside the body, split in eight: volumes and centroids, so that integration points
/// never lie outside.
struct InsideOctants {
  double volume[8];       ///< mm³; 0 where an octant has no inside part
  double centroid[8][3];  ///< mm; undefined where the volume is 0
};

/// Background cells for integration; they need not conform to the body or to the nodes. All cells are of one kind.
struct BackgroundCells {
  CellKind kind = CellKind::hexahedron;
  Points vertices;                         ///< mm, LPS; z = 0 for planar cells
  std::vector<std::int32_t> connectivity;  ///< corners() vertices a cell, VTK order; planar cells counter-clockwise
  std::vector<double> inside_fraction;     ///< one a cell, in (0, 1]: inside volume (planar: area) / volume
  std::vector<std::int32_t> label;         ///< one a cell, tissue at its inside part's centroid
  std::vector<std::int32_t> cut_index;   ///< one a cell: row of cut_parts for a cell cut by the surface, -1 for a whole
                                         ///< one; empty when no cell is cut
  std::vector<InsideOctants> cut_parts;  ///< one a cut hexahedron, octants in the order x fastest, z slowest

  std::size_t size() const { return inside_fraction.size(); }
  int corners() const { return corner_count(kind); }
};

/// Throws std::invalid_argument, naming the cell, where the cells are not what BackgroundCells says: arrays of other
/// lengths, a vertex that is none, a cell that is inverted (planar: clockwise), flat or there twice, planar cells with
/// a vertex off z = 0, a fraction outside (0, 1], octants of more volume than their cell or with a centroid outside it,
/// numbers that are not finite.
void check_cells(const BackgroundCells& cells);

/// cells.vtu: cell arrays inside_fraction, label and, where cells are cut, octant_volume (8) and octant_centroid (24; 0
/// where there is no volume). On reading, inside_fraction may be absent (1), label too (1) and the octant arrays (a cut
/// cell's points are then those of the whole cell, weighted by its fraction). Throws std::invalid_argument, naming file
/// and cell, on a file that is none, mixed or other kinds of cell, and as check_cells() does.
BackgroundCells read_background_cells(const std::filesystem::path& file);
void write_background_cells(const std::filesystem::path& file, const BackgroundCells& cells);

}  // namespace brainshift
