// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private to .cpp files: our surfaces as VTK's and back.

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "segmentation/geometry/surface.hpp"

namespace brainshift {

inline vtkSmartPointer<vtkPolyData> to_vtk(const Surface& surface) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(surface.vertices.rows());
  for (Eigen::Index i = 0; i < surface.vertices.rows(); ++i) {
    points->SetPoint(i, surface.vertices.row(i).data());
  }
  vtkNew<vtkCellArray> cells;
  for (const auto& triangle : surface.triangles.rowwise()) {
    const vtkIdType corners[3] = {triangle[0], triangle[1], triangle[2]};
    cells->InsertNextCell(3, corners);
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(cells);
  return result;
}

/// Every polygon must be a triangle (see vtkTriangleFilter).
inline Surface from_vtk(vtkPolyData& data) {
  Surface surface;
  surface.vertices.resize(data.GetNumberOfPoints(), 3);
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    data.GetPoint(i, surface.vertices.row(i).data());
  }
  vtkCellArray* cells = data.GetPolys();
  surface.triangles.resize(cells->GetNumberOfCells(), 3);
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i) {
    cells->GetCellAtId(i, corners);
    for (int corner = 0; corner < 3; ++corner) {
      surface.triangles(i, corner) = static_cast<std::int32_t>(corners->GetId(corner));
    }
  }
  return surface;
}

}  // namespace brainshift
