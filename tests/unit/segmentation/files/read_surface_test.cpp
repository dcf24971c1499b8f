// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/surface_file.hpp"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkSTLWriter.h>
#include <vtkSphereSource.h>

#include "segmentation/files/vtk_bridge.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::read_surface_test {

class EverySurfaceFormat : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Surface, EverySurfaceFormat, ::testing::Values("vtp", "stl", "ply", "obj", "PLY"),
                         [](const auto& named) { return named.param; });

TEST_P(EverySurfaceFormat, GivesBackTheSurface) {
  const ScratchFolder folder;
  const auto file = folder / ("a." + GetParam());
  Surface surface = tetrahedron();
  surface.vertices.array() += 1.0 / 3.0;
  write_surface(file, surface);
  const Surface back = read_surface(file);
  ASSERT_EQ(back.vertices.rows(), 4);
  ASSERT_EQ(back.triangles.rows(), 4);
  EXPECT_NEAR(volume(back), 4500.0, 1e-3);
  if (GetParam() != "stl") {
    EXPECT_EQ(back.vertices, surface.vertices);
    EXPECT_EQ(back.triangles, surface.triangles);
  }
}

TEST_P(EverySurfaceFormat, IsRefusedWhenCutInItsMiddle) {
  const ScratchFolder folder;
  const auto file = folder / ("a." + GetParam());
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(20);
  source->SetPhiResolution(20);
  source->Update();
  write_surface(file, from_vtk(*source->GetOutput()));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2 - 1);
  if (GetParam() == "obj") {  // a text without an end: what is cut off can only be seen where it is missed
    std::ofstream(file, std::ios::app) << "\nf 1 2 99999\n";
  }
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_surface(file); }, {file.string()}));
}

TEST_P(EverySurfaceFormat, IsRefusedWhenEmptyMissingOrProse) {
  const ScratchFolder folder;
  const auto file = folder / ("a." + GetParam());
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_surface(file); }, {file.string(), "no such file"}));
  std::ofstream(file).flush();
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_surface(file); }, {file.string(), "empty"}));
  std::ofstream(file)
      << "these are words, and none of them is a triangle of any kind whatsoever, however long it is read";
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_surface(file); }, {file.string()}));
}

TEST_P(EverySurfaceFormat, AnUnwritableFolderIsAFault) {
  EXPECT_TRUE(throws_saying<std::runtime_error>([] { write_surface("/nonexistent/a." + GetParam(), tetrahedron()); },
                                                {"/nonexistent/a."}));
}

TEST(SurfaceIo, AnStlInTextOfVtkIsRead) {
  const ScratchFolder folder;
  vtkNew<vtkSTLWriter> writer;
  const auto data = to_vtk(tetrahedron());
  writer->SetInputData(data);
  writer->SetFileTypeToASCII();
  writer->SetFileName((folder / "t.stl").c_str());
  writer->Write();
  const Surface surface = read_surface(folder / "t.stl");
  EXPECT_EQ(surface.vertices.rows(), 4);
  EXPECT_NEAR(volume(surface), 4500.0, 1e-3);
}

TEST(SurfaceIo, ASquareFaceBecomesTwoTriangles) {
  const ScratchFolder folder;
  std::ofstream(folder / "s.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 -1//1\n";
  EXPECT_EQ(read_surface(folder / "s.obj").triangles.rows(), 2);
}

TEST(SurfaceIo, ACoordinateThatIsNotFiniteIsNamedWithItsVertex) {
  const ScratchFolder folder;
  const auto file = folder / "bad.obj";
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n";
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_surface(file); }, {"vertex 3", "finite"}));
}

// CGAL's wrapping ends the program on a soup without extent.
TEST(SurfaceIo, FacesInOnePointOrLineAreNoSurface) {
  const ScratchFolder folder;
  for (const std::string text :
       {"v 0 0 0\nf 1 1 1\n", "v 0 0 0\nv 30 0 0\nf 1 2 1\n", "v 5 5 5\nv 5 5 5\nv 5 5 5\nv 5 5 5\nf 1 2 3\nf 1 2 4\n",
        "v 0.1 0.1 0.1\nv 0.2 0.2 0.2\nv 0.3 0.3 0.3\nf 1 2 3\n"}) {
    const auto file = folder.write("a.obj", text);
    EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_surface(file); }, {"a.obj", "line"})) << text;
  }
}

TEST(SurfaceIo, AVtpThatClaimsMoreThanItsLengthAllowsIsRefusedBeforeAnythingIsAllocated) {
  const ScratchFolder folder;
  const auto file = folder / "a.vtp";
  write_surface(file, tetrahedron());
  const std::string sound = bytes_of(file);
  for (const std::string name : {"NumberOfPoints=\"", "NumberOfPolys=\"", "NumberOfComponents=\""}) {
    for (const std::string number : {"1000000000", "99999999999999999999"}) {
      std::string text = sound;
      const std::size_t place = text.find(name) + name.size();
      text.replace(place, text.find('"', place) - place, number);
      EXPECT_TRUE(
          throws_saying<std::invalid_argument>([&] { read_surface(folder.write("b.vtp", text)); }, {"b.vtp", "length"}))
          << name << number;
    }
  }
}

// VTK's filters follow the numbers out of the array.
TEST(SurfaceIo, AVtpWhoseCellsNameNoPointIsRefused) {
  const ScratchFolder folder;
  for (const std::string corners_and_offsets :
       {"0 1 2 900000000 0 1 3;4 7", "0 1 2 -5 0 1 3;4 7", "0 1 2 3 0 1 3;6 4", "0 1 2 3 0 1 3;4 9"}) {
    const std::size_t middle = corners_and_offsets.find(';');
    const auto file = folder.write(
        "a.vtp",
        "<?xml version=\"1.0\"?><VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>"
        "<Piece NumberOfPoints=\"4\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"2\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
        "0 0 0 100 0 0 0 100 0 0 0 100</DataArray></Points><Polys><DataArray type=\"Int64\" Name=\"connectivity\" "
        "format=\"ascii\">" +
            corners_and_offsets.substr(0, middle) +
            "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" +
            corners_and_offsets.substr(middle + 1) + "</DataArray></Polys></Piece></PolyData></VTKFile>");
    EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_surface(file); }, {"a.vtp", "damaged"}))
        << corners_and_offsets;
  }
}

TEST(SurfaceIo, AModelThatSaysRasIsTurnedToLps) {
  const ScratchFolder folder;
  std::ofstream(folder / "r.obj") << "# 3D Slicer output. SPACE=RAS\nv 1 2 3\nv 4 0 0\nv 0 5 0\nf 1 2 3\n";
  const Surface surface = read_surface(folder / "r.obj");
  EXPECT_EQ(surface.vertices.row(0), Eigen::RowVector3d(-1, -2, 3));
}

}  // namespace brainshift::test::read_surface_test
