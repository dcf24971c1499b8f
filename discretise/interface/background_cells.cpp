// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/interface/background_cells.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

#include "segmentation/files/refuse.hpp"
#include "segmentation/files/vtu_file.hpp"
#include "segmentation/geometry/plane.hpp"

namespace brainshift {
namespace {

int vtk_type(CellKind kind) {
  switch (kind) {
    case CellKind::hexahedron:
      return VTK_HEXAHEDRON;
    case CellKind::tetrahedron:
      return VTK_TETRA;
    case CellKind::quadrilateral:
      return VTK_QUAD;
    case CellKind::triangle:
      return VTK_TRIANGLE;
  }
  return VTK_EMPTY_CELL;
}

/// None for a VTK type that no kind of cell is written as.
std::optional<CellKind> kind_of_type(int type) {
  for (const CellKind kind :
       {CellKind::hexahedron, CellKind::tetrahedron, CellKind::quadrilateral, CellKind::triangle}) {
    if (vtk_type(kind) == type) {
      return kind;
    }
  }
  return std::nullopt;
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

CellKind kind_of(const std::filesystem::path& file, vtkUnstructuredGrid& grid) {
  if (grid.GetNumberOfCells() == 0) {
    refuse(file, "there is no cell; hexahedra, tetrahedra, quadrilaterals or triangles are expected.");
  }
  const int first = grid.GetCellType(0);
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    const int type = grid.GetCellType(cell);
    if (!kind_of_type(type)) {
      refuse(file, "cell " + std::to_string(cell) + " is of VTK type " + std::to_string(type) +
                       "; only hexahedra (12), only tetrahedra (10), only quadrilaterals (9) or only triangles (5) "
                       "are expected.");
    }
    if (type != first) {
      refuse(file, "cell " + std::to_string(cell) + " is of another kind than cell 0; kinds cannot be mixed.");
    }
  }
  return *kind_of_type(first);
}

std::vector<std::int32_t> connectivity_of(const std::filesystem::path& file, vtkUnstructuredGrid& grid,
                                          const Points& vertices, CellKind kind) {
  const vtkIdType corners = corner_count(kind);
  std::vector<std::int32_t> connectivity;
  connectivity.reserve(static_cast<std::size_t>(grid.GetNumberOfCells() * corners));
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    grid.GetCellPoints(cell, size, points);
    if (size != corners) {
      refuse(file, "cell " + std::to_string(cell) + " has " + std::to_string(size) + " corners; " +
                       std::to_string(corners) + " are expected.");
    }
    for (vtkIdType k = 0; k < size; ++k) {
      connectivity.push_back(static_cast<std::int32_t>(points[k]));
    }
    if (!(worst_corner(vertices, connectivity.data() + cell * corners, kind) > 1e-12)) {
      refuse(file, "cell " + std::to_string(cell) +
                       (is_planar(kind) ? " is clockwise, not convex or flat; its corners go counter-clockwise about z."
                                        : " is inverted or flat."));
    }
  }
  return connectivity;
}

std::vector<double> fractions_of(const std::filesystem::path& file, vtkUnstructuredGrid& grid, std::size_t cells) {
  std::vector<double> fraction = vtu::array(file, *grid.GetCellData(), "inside_fraction", cells);
  if (fraction.empty()) {
    fraction.assign(cells, 1.0);
  }
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (!(fraction[cell] > 0 && fraction[cell] <= 1)) {
      refuse(file, "cell " + std::to_string(cell) + " has inside_fraction " + std::to_string(fraction[cell]) +
                       "; above 0 and at most 1 is expected.");
    }
  }
  return fraction;
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

/// The inside part must be one of its cell: the points that it gives carry its volume.
void check_cut_part(const std::filesystem::path& file, const BackgroundCells& cells, std::size_t cell,
                    const InsideOctants& part) {
  const std::int32_t* corners = cells.connectivity.data() + 8 * cell;
  const double volume = hexahedron_volume(cells.vertices, corners);
  const double inside = std::accumulate(std::begin(part.volume), std::end(part.volume), 0.0);
  if (inside > 1.001 * volume) {
    refuse(file, "the octants of cell " + std::to_string(cell) + " hold " + std::to_string(inside) +
                     " mm³, more than the cell (" + std::to_string(volume) + " mm³).");
  }
  Eigen::Array3d low = cells.vertices.row(corners[0]), high = low;
  for (int k = 1; k < 8; ++k) {
    const Eigen::Array3d corner = cells.vertices.row(corners[k]);
    low = low.min(corner);
    high = high.max(corner);
  }
  const Eigen::Array3d slack = 1e-3 * (high - low);
  for (int octant = 0; octant < 8; ++octant) {
    const Eigen::Array3d centroid = Eigen::Map<const Eigen::Array3d>(part.centroid[octant]);
    if (part.volume[octant] > 0 && !((centroid >= low - slack).all() && (centroid <= high + slack).all())) {
      refuse(file, "octant " + std::to_string(octant) + " of cell " + std::to_string(cell) +
                       " has its centroid outside the cell.");
    }
  }
}

void read_cut_parts(const std::filesystem::path& file, vtkUnstructuredGrid& grid, BackgroundCells& cells) {
  const std::size_t count = cells.size();
  const std::vector<double> volume = vtu::array(file, *grid.GetCellData(), "octant_volume", count, 8);
  const std::vector<double> centroid = vtu::array(file, *grid.GetCellData(), "octant_centroid", count, 24);
  if (volume.empty() || centroid.empty() || cells.kind != CellKind::hexahedron) {
    return;
  }
  cells.cut_index.assign(count, -1);
  for (std::size_t cell = 0; cell < count; ++cell) {
    InsideOctants part{};
    double inside = 0;
    for (std::size_t octant = 0; octant < 8; ++octant) {
      part.volume[octant] = volume[cell * 8 + octant];
      bool finite = part.volume[octant] >= 0 && std::isfinite(part.volume[octant]);
      for (std::size_t k = 0; k < 3; ++k) {
        part.centroid[octant][k] = centroid[cell * 24 + octant * 3 + k];
        finite = finite && std::isfinite(part.centroid[octant][k]);
      }
      if (!finite) {
        refuse(file, "cell " + std::to_string(cell) +
                         " has an octant with a negative volume or a number that is not "
                         "finite.");
      }
      inside += part.volume[octant];
    }
    check_cut_part(file, cells, cell, part);
    if (inside > 0) {
      cells.cut_index[cell] = static_cast<std::int32_t>(cells.cut_parts.size());
      cells.cut_parts.push_back(part);
    }
  }
  if (cells.cut_parts.empty()) {
    cells.cut_index.clear();
  }
}

void add_cut_parts(vtkCellData& data, const BackgroundCells& cells) {
  std::vector<double> volume(cells.size() * 8, 0.0);
  std::vector<double> centroid(cells.size() * 24, 0.0);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (cells.cut_index[cell] < 0) {
      continue;
    }
    const InsideOctants& part = cells.cut_parts[static_cast<std::size_t>(cells.cut_index[cell])];
    for (std::size_t octant = 0; octant < 8; ++octant) {
      volume[cell * 8 + octant] = part.volume[octant];
      if (part.volume[octant] > 0) {
        std::copy_n(part.centroid[octant], 3, centroid.begin() + static_cast<std::ptrdiff_t>(cell * 24 + octant * 3));
      }
    }
  }
  vtu::add_array(data, "octant_volume", volume, 8);
  vtu::add_array(data, "octant_centroid", centroid, 24);
}

}  // namespace

BackgroundCells read_background_cells(const std::filesystem::path& file) {
  const auto grid = vtu::read(file);
  BackgroundCells cells;
  cells.kind = kind_of(file, *grid);
  cells.vertices = vtu::points(file, *grid, "vertex");
  if (is_planar(cells.kind)) {
    if (const auto fault = off_plane(cells.vertices, "vertex")) {
      refuse(file, *fault);
    }
  }
  cells.connectivity = connectivity_of(file, *grid, cells.vertices, cells.kind);
  const auto count = static_cast<std::size_t>(grid->GetNumberOfCells());
  cells.inside_fraction = fractions_of(file, *grid, count);
  cells.label = vtu::whole_number_array(file, *grid->GetCellData(), "label", count, "cell");
  if (cells.label.empty()) {
    cells.label.assign(count, 1);
  }
  read_cut_parts(file, *grid, cells);
  return cells;
}

void write_background_cells(const std::filesystem::path& file, const BackgroundCells& cells) {
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(vtu::to_vtk(cells.vertices));
  const auto corners = static_cast<std::size_t>(cells.corners());
  grid->AllocateEstimate(static_cast<vtkIdType>(cells.size()), cells.corners());
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    vtkIdType points[8];
    std::copy_n(cells.connectivity.begin() + static_cast<std::ptrdiff_t>(cell * corners), corners, points);
    grid->InsertNextCell(vtk_type(cells.kind), cells.corners(), points);
  }
  vtkCellData& data = *grid->GetCellData();
  vtu::add_array(data, "inside_fraction", cells.inside_fraction);
  vtu::add_array(data, "label", cells.label);
  if (!cells.cut_parts.empty()) {
    add_cut_parts(data, cells);
  }
  vtu::write(file, *grid);
}

}  // namespace brainshift
