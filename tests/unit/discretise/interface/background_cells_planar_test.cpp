// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/interface/background_cells.hpp"

#include <gtest/gtest.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::background_cells_planar_test {

using test::refusal;
using test::ScratchFolder;

/// Two quadrilaterals side by side, the second skew and partly outside.
BackgroundCells two_quadrilaterals() {
  BackgroundCells cells;
  cells.kind = CellKind::quadrilateral;
  cells.vertices = Points(6, 3);
  cells.vertices << 0, 0, 0, 1, 0, 0, 2.5, 0.5, 0, 0, 1, 0, 1, 1, 0, 2, 4.0 / 3.0, 0;
  cells.connectivity = {0, 1, 4, 3, 1, 2, 5, 4};
  cells.inside_fraction = {1.0, 0.3};
  cells.label = {1, 2};
  return cells;
}

BackgroundCells two_triangles() {
  BackgroundCells cells = two_quadrilaterals();
  cells.kind = CellKind::triangle;
  cells.connectivity = {0, 1, 4, 0, 4, 3};
  return cells;
}

std::string refused(const BackgroundCells& cells) {
  const ScratchFolder folder;
  write_background_cells(folder / "cells.vtu", cells);
  return refusal([&] { read_background_cells(folder / "cells.vtu"); });
}

TEST(CellKinds, KnowTheirCornersAndWhetherTheyArePlanar) {
  EXPECT_EQ(corner_count(CellKind::hexahedron), 8);
  EXPECT_EQ(corner_count(CellKind::tetrahedron), 4);
  EXPECT_EQ(two_quadrilaterals().corners(), 4);
  EXPECT_EQ(two_triangles().corners(), 3);
  EXPECT_FALSE(is_planar(CellKind::hexahedron) || is_planar(CellKind::tetrahedron));
  EXPECT_TRUE(is_planar(CellKind::quadrilateral) && is_planar(CellKind::triangle));
}

TEST(PlanarCellsFile, ReturnsEveryBitOfTheCells) {
  const ScratchFolder folder;
  for (const BackgroundCells& cells : {two_quadrilaterals(), two_triangles()}) {
    write_background_cells(folder / "cells.vtu", cells);
    const BackgroundCells read = read_background_cells(folder / "cells.vtu");
    EXPECT_EQ(read.kind, cells.kind);
    EXPECT_EQ(read.vertices, cells.vertices);
    EXPECT_EQ(read.connectivity, cells.connectivity);
    EXPECT_EQ(read.inside_fraction, cells.inside_fraction);
    EXPECT_EQ(read.label, cells.label);
  }
}

TEST(PlanarCellsFile, IsWhatVtkReadsAsQuadrilateralsOrTriangles) {
  const ScratchFolder folder;
  const auto first_type = [&](const BackgroundCells& cells) {
    write_background_cells(folder / "cells.vtu", cells);
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName((folder / "cells.vtu").c_str());
    reader->Update();
    return reader->GetOutput()->GetCellType(0);
  };
  EXPECT_EQ(first_type(two_quadrilaterals()), VTK_QUAD);
  EXPECT_EQ(first_type(two_triangles()), VTK_TRIANGLE);
}

TEST(PlanarCellsFile, WithAVertexOffThePlaneIsRefusedWithThatVertex) {
  for (BackgroundCells cells : {two_quadrilaterals(), two_triangles()}) {
    cells.vertices(4, 2) = 0.25;
    const std::string sentence = refused(cells);
    EXPECT_NE(sentence.find("vertex 4 has z = 0.25"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("cells.vtu"), std::string::npos) << sentence;
  }
}

TEST(PlanarCellsFile, WithAClockwiseCellIsRefusedWithThatCell) {
  BackgroundCells cells = two_quadrilaterals();
  cells.connectivity = {0, 1, 4, 3, 4, 5, 2, 1};
  EXPECT_NE(refused(cells).find("cell 1 is clockwise"), std::string::npos);
  cells = two_triangles();
  cells.connectivity = {0, 4, 1, 0, 4, 3};
  EXPECT_NE(refused(cells).find("cell 0 is clockwise"), std::string::npos);
}

TEST(PlanarCellsFile, WithAFoldedFlatOrVanishedCellIsRefused) {
  BackgroundCells cells = two_quadrilaterals();
  std::swap(cells.connectivity[2], cells.connectivity[3]);  // a bow tie
  EXPECT_NE(refused(cells).find("cell 0 is"), std::string::npos);
  cells = two_quadrilaterals();
  cells.vertices.row(4) << 0.2, 0.2, 0;  // not convex
  EXPECT_NE(refused(cells).find("cell 0 is"), std::string::npos);
  cells = two_triangles();
  cells.vertices.row(4) << 3, 0, 0;  // on one line with 0 and 1
  EXPECT_NE(refused(cells).find("cell 0 is"), std::string::npos);
  cells = two_triangles();
  cells.connectivity = {0, 1, 4, 3, 3, 3};
  EXPECT_NE(refused(cells).find("cell 1 is"), std::string::npos);
}

vtkSmartPointer<vtkUnstructuredGrid> unit_square(int cell_type) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  const double corner[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const auto& x : corner) {
    points->InsertNextPoint(x);
  }
  grid->SetPoints(points);
  const vtkIdType ids[4] = {0, 1, 2, 3};
  grid->InsertNextCell(cell_type, 4, ids);
  return grid;
}

TEST(PlanarCellsFile, OfPixelsOrMixedKindsIsRefused) {
  const ScratchFolder folder;
  const auto refused_grid = [&](vtkUnstructuredGrid* grid) {
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetFileName((folder / "grid.vtu").c_str());
    writer->SetInputData(grid);
    writer->Write();
    return refusal([&] { read_background_cells(folder / "grid.vtu"); });
  };
  EXPECT_NE(refused_grid(unit_square(VTK_PIXEL)).find("VTK type 8"), std::string::npos);
  const auto mixed = unit_square(VTK_QUAD);
  const vtkIdType ids[3] = {0, 1, 2};
  mixed->InsertNextCell(VTK_TRIANGLE, 3, ids);
  EXPECT_NE(refused_grid(mixed).find("cell 1 is of another kind"), std::string::npos);
}

}  // namespace brainshift::background_cells_planar_test
