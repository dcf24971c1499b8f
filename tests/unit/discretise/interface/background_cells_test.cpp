// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/interface/background_cells.hpp"

#include <gtest/gtest.h>
#include <vtkCellType.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTriangleFilter.h>
#include <vtkUnstructuredGrid.h>

#include <limits>

#include "discretise/interface/node_cloud.hpp"
#include "tests/unit/discretise/foreign_mesh.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::background_cells_test {

using test::bytes_of;
using test::foreign_cube;
using test::read_with_vtk;
using test::refusal;
using test::ScratchFolder;
using test::write_with_vtk;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Two unit cubes side by side; the second is cut.
BackgroundCells some_hexahedra() {
  BackgroundCells cells;
  cells.vertices = Points(12, 3);
  for (int i = 0; i < 12; ++i) {
    cells.vertices.row(i) << i % 3, (i / 3) % 2, i / 6;
  }
  cells.connectivity = {0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10};
  cells.inside_fraction = {1.0, 0.3};
  cells.label = {1, 2};
  cells.cut_index = {-1, 0};
  InsideOctants part{};
  part.volume[0] = 0.1;
  part.volume[6] = 0.2;
  const double centroid[2][3] = {{1.2, 0.2, 0.3}, {1.1, 0.7, 0.8}};
  for (int k = 0; k < 3; ++k) {
    part.centroid[0][k] = centroid[0][k];
    part.centroid[6][k] = centroid[1][k];
  }
  cells.cut_parts = {part};
  return cells;
}

BackgroundCells one_tetrahedron() {
  BackgroundCells cells;
  cells.kind = CellKind::tetrahedron;
  cells.vertices = Points(4, 3);
  cells.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  cells.connectivity = {0, 1, 2, 3};
  cells.inside_fraction = {1};
  cells.label = {1};
  return cells;
}

TEST(CellsFile, ReturnsEveryBitOfTheCells) {
  const ScratchFolder folder;
  const BackgroundCells cells = some_hexahedra();
  write_background_cells(folder / "cells.vtu", cells);
  const BackgroundCells read = read_background_cells(folder / "cells.vtu");
  EXPECT_EQ(read.kind, CellKind::hexahedron);
  EXPECT_EQ(read.vertices, cells.vertices);
  EXPECT_EQ(read.connectivity, cells.connectivity);
  EXPECT_EQ(read.inside_fraction, cells.inside_fraction);
  EXPECT_EQ(read.label, cells.label);
  EXPECT_EQ(read.cut_index, cells.cut_index);
  ASSERT_EQ(read.cut_parts.size(), 1U);
  for (int octant = 0; octant < 8; ++octant) {
    EXPECT_EQ(read.cut_parts[0].volume[octant], cells.cut_parts[0].volume[octant]);
  }
  EXPECT_EQ(read.cut_parts[0].centroid[6][2], 0.8);
}

TEST(CellsFile, RefusesOctantsThatAreNotPartsOfTheirCell) {
  const ScratchFolder folder;
  const auto file = folder / "cells.vtu";
  const auto refused = [&](double volume, double x) {
    BackgroundCells cells = some_hexahedra();
    cells.cut_parts[0].volume[6] = volume;
    cells.cut_parts[0].centroid[6][0] = x;
    write_background_cells(file, cells);
    return refusal([&] { read_background_cells(file); });
  };
  EXPECT_EQ(refused(0.2, 1.1), "");
  EXPECT_EQ(refused(0.9, 1.0), "") << "the whole cell";
  for (const double volume : {0.95, 10.0, 1e30}) {
    test::expect_parts(refused(volume, 1.1), {"cells.vtu", "octants of cell 1", "more than the cell"});
  }
  for (const double x : {0.9, 2.1, 1e30}) {
    test::expect_parts(refused(0.2, x), {"cells.vtu", "octant 6 of cell 1", "outside"});
  }
}

TEST(CellsFile, HasTheVolumesThatVtkComputes) {
  const ScratchFolder folder;
  write_background_cells(folder / "hexahedra.vtu", some_hexahedra());
  write_background_cells(folder / "tetrahedra.vtu", one_tetrahedron());
  const auto volume = [](const std::filesystem::path& file) {
    const auto grid = read_with_vtk(file);
    vtkNew<vtkDataSetSurfaceFilter> surface;
    surface->SetInputData(grid);
    vtkNew<vtkTriangleFilter> triangles;
    triangles->SetInputConnection(surface->GetOutputPort());
    vtkNew<vtkMassProperties> mass;
    mass->SetInputConnection(triangles->GetOutputPort());
    mass->Update();
    return mass->GetVolume();
  };
  EXPECT_NEAR(volume(folder / "hexahedra.vtu"), 2.0, 1e-12);
  EXPECT_NEAR(volume(folder / "tetrahedra.vtu"), 1.0 / 6.0, 1e-12);
}

TEST(CellsFile, OfAnotherProgramIsWholeAndOfTissueOne) {
  const ScratchFolder folder;
  write_with_vtk(folder / "cube.vtu", foreign_cube(VTK_HEXAHEDRON));
  const BackgroundCells cells = read_background_cells(folder / "cube.vtu");
  ASSERT_EQ(cells.size(), 1U);
  EXPECT_EQ(cells.inside_fraction[0], 1.0);
  EXPECT_EQ(cells.label[0], 1);
  EXPECT_TRUE(cells.cut_index.empty());
}

TEST(CellsFile, IsRefusedWithTheCellThatIsWrong) {
  const ScratchFolder folder;
  const auto refused = [&](const BackgroundCells& cells) {
    write_background_cells(folder / "cells.vtu", cells);
    return refusal([&] { read_background_cells(folder / "cells.vtu"); });
  };
  BackgroundCells bad = one_tetrahedron();
  bad.connectivity = {1, 0, 2, 3};
  EXPECT_NE(refused(bad).find("cell 0 is inverted or flat"), std::string::npos);
  bad = one_tetrahedron();
  bad.vertices.row(3) << 0.5, 0.5, 0;
  EXPECT_NE(refused(bad).find("cell 0 is inverted or flat"), std::string::npos);
  bad = some_hexahedra();
  std::swap(bad.connectivity[8], bad.connectivity[9]);
  EXPECT_NE(refused(bad).find("cell 1 is inverted or flat"), std::string::npos);
  for (const double fraction : {0.0, -0.1, 1.1, nan}) {
    bad = some_hexahedra();
    bad.inside_fraction[1] = fraction;
    EXPECT_NE(refused(bad).find("cell 1 has inside_fraction"), std::string::npos) << fraction;
  }
  bad = some_hexahedra();
  bad.cut_parts[0].volume[3] = -1;
  EXPECT_NE(refused(bad).find("cell 1 has an octant"), std::string::npos);
  EXPECT_NE(refused(BackgroundCells{}).find("no cell"), std::string::npos);
}

TEST(CellsFile, OfOtherOrMixedKindsIsRefused) {
  const ScratchFolder folder;
  write_with_vtk(folder / "voxel.vtu", foreign_cube(VTK_VOXEL));
  EXPECT_NE(refusal([&] { read_background_cells(folder / "voxel.vtu"); }).find("VTK type 11"), std::string::npos);
  const auto grid = foreign_cube(VTK_HEXAHEDRON);
  const vtkIdType ids[4] = {0, 1, 3, 4};
  grid->InsertNextCell(VTK_TETRA, 4, ids);
  write_with_vtk(folder / "mixed.vtu", grid);
  EXPECT_NE(refusal([&] { read_background_cells(folder / "mixed.vtu"); }).find("cannot be mixed"), std::string::npos);
}

TEST(CellsFile, ThatNamesAPointWhichDoesNotExistIsRefused) {
  const ScratchFolder folder;
  const auto grid = foreign_cube(VTK_HEXAHEDRON);
  write_with_vtk(folder / "cube.vtu", grid);
  std::string text = bytes_of(folder / "cube.vtu");
  const std::size_t connectivity = text.find("0 1 2 3 4 5");
  ASSERT_NE(connectivity, std::string::npos);
  text.replace(connectivity, 11, "0 1 2 3 4 9");
  std::ofstream(folder / "cube.vtu") << text;
  EXPECT_NE(refusal([&] { read_background_cells(folder / "cube.vtu"); }).find("damaged"), std::string::npos);
}

}  // namespace brainshift::background_cells_test
