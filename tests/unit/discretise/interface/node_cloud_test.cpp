// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/interface/node_cloud.hpp"

#include <gtest/gtest.h>
#include <vtkCellType.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <limits>

#include "discretise/interface/background_cells.hpp"
#include "tests/unit/discretise/foreign_mesh.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::node_cloud_test {

using test::bytes_of;
using test::foreign_cube;
using test::read_with_vtk;
using test::refusal;
using test::ScratchFolder;
using test::write_with_vtk;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

NodeCloud some_cloud() {
  NodeCloud cloud;
  cloud.positions = Points(5, 3);
  cloud.positions << -100.25, 1.0 / 3.0, 7, 1, 0, 0, 0, 1, 0, 0, 0, 1e-7, 3, 3, 3;
  cloud.spacing = {1.5, 0.1, 2, 3, 4};
  cloud.on_surface = {1, 0, 1, 0, 0};
  return cloud;
}

TEST(NodesFile, ReturnsEveryBitOfTheCloud) {
  const ScratchFolder folder;
  const NodeCloud cloud = some_cloud();
  write_node_cloud(folder / "nodes.vtu", cloud);
  const NodeCloud read = read_node_cloud(folder / "nodes.vtu");
  EXPECT_EQ(read.positions, cloud.positions);
  EXPECT_EQ(read.spacing, cloud.spacing);
  EXPECT_EQ(read.on_surface, cloud.on_surface);
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
  EXPECT_EQ(data->GetNumberOfArrays(), 2);
  EXPECT_EQ(data->GetArray("spacing")->GetTuple1(1), 0.1);
  EXPECT_EQ(data->GetArray("on_surface")->GetTuple1(2), 1);
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
  }
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
  EXPECT_NE(refused(NodeCloud{}).find("nodes.vtu"), std::string::npos);
}

TEST(NodesFile, IsRefusedWhenAnArrayHasTheWrongShape) {
  const ScratchFolder folder;
  const auto grid = foreign_cube(VTK_HEXAHEDRON);
  vtkNew<vtkFloatArray> vectors;
  vectors->SetName("spacing");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(8);
  vectors->Fill(1);
  grid->GetPointData()->AddArray(vectors);
  write_with_vtk(folder / "mesh.vtu", grid);
  EXPECT_NE(refusal([&] { read_node_cloud(folder / "mesh.vtu"); }).find("spacing"), std::string::npos);
}

}  // namespace brainshift::node_cloud_test
