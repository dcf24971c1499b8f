// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/vtk_cells.hpp"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <string>

#include "segmentation/files/refuse.hpp"

namespace brainshift {
namespace {

void check_cells(const std::filesystem::path& file, vtkCellArray* cells, vtkIdType points) {
  if (cells == nullptr) {
    return;
  }
  vtkDataArray& offsets = *cells->GetOffsetsArray();
  vtkDataArray& corners = *cells->GetConnectivityArray();
  const auto corner_count = static_cast<double>(corners.GetNumberOfValues());
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell) {
    const double begin = offsets.GetTuple1(cell), end = offsets.GetTuple1(cell + 1);
    if (!(begin >= 0 && begin <= end && end <= corner_count)) {
      refuse(file, "cell " + std::to_string(cell) + " has offsets outside the connectivity; the file is damaged");
    }
    for (auto corner = static_cast<vtkIdType>(begin); corner < static_cast<vtkIdType>(end); ++corner) {
      const double point = corners.GetTuple1(corner);
      if (!(point >= 0 && point < static_cast<double>(points))) {
        refuse(file, "cell " + std::to_string(cell) + " names a point that does not exist; the file is damaged");
      }
    }
  }
}

}  // namespace

void check_cells(const std::filesystem::path& file, vtkPointSet& model) {
  const vtkIdType points = model.GetNumberOfPoints();
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(&model)) {
    check_cells(file, grid->GetCells(), points);
  } else if (auto* const data = vtkPolyData::SafeDownCast(&model)) {
    for (vtkCellArray* cells : {data->GetVerts(), data->GetLines(), data->GetPolys(), data->GetStrips()}) {
      check_cells(file, cells, points);
    }
  }
}

}  // namespace brainshift
