// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <filesystem>

namespace brainshift::test {

inline vtkSmartPointer<vtkUnstructuredGrid> read_with_vtk(const std::filesystem::path& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

inline void write_with_vtk(const std::filesystem::path& file, vtkUnstructuredGrid* grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetDataModeToAscii();
  writer->SetInputData(grid);
  writer->Write();
}

/// Another program's mesh: eight corners of a cube as floats, no arrays.
inline vtkSmartPointer<vtkUnstructuredGrid> foreign_cube(int cell_type) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  const double corner[8][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}};
  for (const auto& x : corner) {
    points->InsertNextPoint(x);
  }
  grid->SetPoints(points);
  const vtkIdType ids[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  grid->InsertNextCell(cell_type, 8, ids);
  return grid;
}

}  // namespace brainshift::test
