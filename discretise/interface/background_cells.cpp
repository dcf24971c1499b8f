// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/interface/background_cells.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>

#include "segmentation/files/naming.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/vtu_file.hpp"

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

std::vector<std::int32_t> connectivity_of(const std::filesystem::path& file, vtkUnstructuredGrid& grid, CellKind kind) {
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
  }
  return connectivity;
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
    std::copy_n(volume.begin() + static_cast<std::ptrdiff_t>(8 * cell), 8, part.volume);
    std::copy_n(centroid.begin() + static_cast<std::ptrdiff_t>(24 * cell), 24, &part.centroid[0][0]);
    const auto is_none = [](double inside) { return inside == 0; };
    if (!std::all_of(std::begin(part.volume), std::end(part.volume), is_none)) {
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
  cells.connectivity = connectivity_of(file, *grid, cells.kind);
  const auto count = static_cast<std::size_t>(grid->GetNumberOfCells());
  cells.inside_fraction = vtu::array(file, *grid->GetCellData(), "inside_fraction", count);
  if (cells.inside_fraction.empty()) {
    cells.inside_fraction.assign(count, 1.0);
  }
  cells.label = vtu::whole_number_array(file, *grid->GetCellData(), "label", count, "cell");
  if (cells.label.empty()) {
    cells.label.assign(count, 1);
  }
  read_cut_parts(file, *grid, cells);
  naming(file.string(), [&] { check_cells(cells); });
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
