// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTriangleFilter.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cmath>
#include <limits>

#include "discretise/background_cells.hpp"
#include "discretise/node_cloud.hpp"
#include "tests/unit/discretise/scratch_folder.hpp"

namespace brainshift {
namespace {

using test::bytes_of;
using test::refusal;
using test::ScratchFolder;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

NodeCloud some_cloud() {
  NodeCloud cloud;
  cloud.positions = Points(5, 3);
  cloud.positions << -100.25, 1.0 / 3.0, 7, 1, 0, 0, 0, 1, 0, 0, 0, 1e-7, 3, 3, 3;
  cloud.spacing = {1.5, 0.1, 2, 3, 4};
  cloud.on_surface = {1, 0, 1, 0, 0};
  cloud.label = {1, 2, 3, -4, 70000};
  return cloud;
}

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

vtkSmartPointer<vtkUnstructuredGrid> read_with_vtk(const std::filesystem::path& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

void write_with_vtk(const std::filesystem::path& file, vtkUnstructuredGrid* grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetDataModeToAscii();
  writer->SetInputData(grid);
  writer->Write();
}

/// Another program's mesh: eight corners of a cube as floats, no arrays.
vtkSmartPointer<vtkUnstructuredGrid> foreign_cube(int cell_type) {
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

TEST(NodesFile, ReturnsEveryBitOfTheCloud) {
  const ScratchFolder folder;
  NodeCloud cloud = some_cloud();
  cloud.prescribed_displacement = Points::Constant(5, 3, nan);
  cloud.prescribed_displacement.row(1) << 0.1, -2, nan;
  write_node_cloud(folder / "nodes.vtu", cloud);
  const NodeCloud read = read_node_cloud(folder / "nodes.vtu");
  EXPECT_EQ(read.positions, cloud.positions);
  EXPECT_EQ(read.spacing, cloud.spacing);
  EXPECT_EQ(read.on_surface, cloud.on_surface);
  EXPECT_EQ(read.label, cloud.label);
  ASSERT_EQ(read.prescribed_displacement.rows(), 5);
  EXPECT_EQ(read.prescribed_displacement(1, 1), -2);
  EXPECT_TRUE(std::isnan(read.prescribed_displacement(1, 2)));
  EXPECT_TRUE(std::isnan(read.prescribed_displacement(4, 0)));
}

TEST(NodesFile, IsWhatVtkReadsAsVerticesWithNamedArrays) {
  const ScratchFolder folder;
  write_node_cloud(folder / "nodes.vtu", some_cloud());
  const auto grid = read_with_vtk(folder / "nodes.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), 5);
  ASSERT_EQ(grid->GetNumberOfCells(), 5);
  EXPECT_EQ(grid->GetCellType(4), VTK_VERTEX);
  EXPECT_EQ(grid->GetPoint(0)[1], 1.0 / 3.0);
  vtkPointData* data = grid->GetPointData();
  EXPECT_EQ(data->GetNumberOfArrays(), 3);
  EXPECT_EQ(data->GetArray("spacing")->GetTuple1(1), 0.1);
  EXPECT_EQ(data->GetArray("on_surface")->GetTuple1(2), 1);
  EXPECT_EQ(data->GetArray("label")->GetTuple1(4), 70000);
}

TEST(NodesFile, IsTheSameBytesEachTime) {
  const ScratchFolder folder;
  write_node_cloud(folder / "a.vtu", some_cloud());
  write_node_cloud(folder / "b.vtu", some_cloud());
  EXPECT_FALSE(bytes_of(folder / "a.vtu").empty());
  EXPECT_EQ(bytes_of(folder / "a.vtu"), bytes_of(folder / "b.vtu"));
}

TEST(NodesFile, OfAnotherProgramGetsTheDistanceOfItsNeighboursForSpacing) {
  const ScratchFolder folder;
  write_with_vtk(folder / "mesh.vtu", foreign_cube(VTK_HEXAHEDRON));
  const NodeCloud cloud = read_node_cloud(folder / "mesh.vtu");
  ASSERT_EQ(cloud.size(), 8U);
  const double six_nearest = (3 * 2 + 3 * 2 * std::sqrt(2.0)) / 6;
  for (std::size_t node = 0; node < 8; ++node) {
    EXPECT_NEAR(cloud.spacing[node], six_nearest, 1e-12);
    EXPECT_EQ(cloud.on_surface[node], 0);
    EXPECT_EQ(cloud.label[node], 1);
  }
  EXPECT_EQ(cloud.prescribed_displacement.rows(), 0);
}

TEST(NodesFile, IsRefusedWithTheNodeThatIsWrong) {
  const ScratchFolder folder;
  const auto refused = [&](const NodeCloud& cloud) {
    write_node_cloud(folder / "nodes.vtu", cloud);
    return refusal([&] { read_node_cloud(folder / "nodes.vtu"); });
  };
  NodeCloud bad = some_cloud();
  bad.positions(3, 1) = nan;
  EXPECT_NE(refused(bad).find("node 3"), std::string::npos);
  bad = some_cloud();
  bad.spacing[2] = 0;
  EXPECT_NE(refused(bad).find("node 2"), std::string::npos);
  bad = some_cloud();
  bad.spacing[2] = nan;
  EXPECT_NE(refused(bad).find("node 2"), std::string::npos);
  bad = some_cloud();
  bad.positions.row(4) = bad.positions.row(0);
  EXPECT_NE(refused(bad).find("nodes 0 and 4"), std::string::npos);
  bad = some_cloud();
  bad.prescribed_displacement = Points::Constant(5, 3, std::numeric_limits<double>::infinity());
  EXPECT_NE(refused(bad).find("node 0"), std::string::npos);
  EXPECT_NE(refused(NodeCloud{}).find("nodes.vtu"), std::string::npos);
}

TEST(NodesFile, IsRefusedWhenAnArrayHasTheWrongShape) {
  const ScratchFolder folder;
  const auto grid = foreign_cube(VTK_HEXAHEDRON);
  vtkNew<vtkFloatArray> scalar;
  scalar->SetName("prescribed_displacement");
  scalar->SetNumberOfTuples(8);
  scalar->Fill(1);
  grid->GetPointData()->AddArray(scalar);
  write_with_vtk(folder / "mesh.vtu", grid);
  EXPECT_NE(refusal([&] { read_node_cloud(folder / "mesh.vtu"); }).find("prescribed_displacement"), std::string::npos);
}

TEST(VtuFile, ThatIsMissingEmptyTruncatedOrSomethingElseIsRefusedByName) {
  const ScratchFolder folder;
  const auto refused = [&](const std::string& name) {
    const std::string sentence = refusal([&] { read_node_cloud(folder / name); });
    return sentence.find(name) != std::string::npos;
  };
  EXPECT_TRUE(refused("missing.vtu"));
  std::ofstream(folder / "empty.vtu").close();
  EXPECT_TRUE(refused("empty.vtu"));
  std::ofstream(folder / "text.vtu") << "x,y,z\n1,2,3\n";
  EXPECT_TRUE(refused("text.vtu"));
  std::ofstream(folder / "poly.vtu") << R"(<VTKFile type="PolyData" version="1.0"><PolyData/></VTKFile>)";
  EXPECT_TRUE(refused("poly.vtu"));
  write_node_cloud(folder / "whole.vtu", some_cloud());
  const std::string whole = bytes_of(folder / "whole.vtu");
  for (const double part : {0.2, 0.5, 0.8, 0.95}) {
    std::ofstream(folder / "part.vtu", std::ios::binary)
        << whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size())));
    EXPECT_TRUE(refused("part.vtu")) << part;
  }
}

TEST(VtuFile, ThatCannotBeWrittenIsAFaultOfOutput) {
  EXPECT_THROW(write_node_cloud("/nonexistent/folder/nodes.vtu", some_cloud()), std::runtime_error);
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_THROW(write_node_cloud("/dev/full", some_cloud()), std::runtime_error);
  }
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

}  // namespace
}  // namespace brainshift
