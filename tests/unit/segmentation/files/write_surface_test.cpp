// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/surface_file.hpp"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkXMLPolyDataReader.h>

#include "segmentation/files/vtk_bridge.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::write_surface_test {

template <class Reader>
vtkSmartPointer<vtkPolyData> read_by(const std::filesystem::path& file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

TEST(SurfaceIo, VtksOwnReadersSeeTheSameBody) {
  const ScratchFolder folder;
  for (const char* ending : {"vtp", "stl", "ply", "obj"}) {
    write_surface(folder / (std::string("a.") + ending), tetrahedron());
  }
  EXPECT_NEAR(volume(from_vtk(*read_by<vtkXMLPolyDataReader>(folder / "a.vtp"))), 4500.0, 1e-9);
  EXPECT_NEAR(volume(from_vtk(*read_by<vtkSTLReader>(folder / "a.stl"))), 4500.0, 1e-2);
  EXPECT_NEAR(volume(from_vtk(*read_by<vtkPLYReader>(folder / "a.ply"))), 4500.0, 1e-2);
  EXPECT_NEAR(volume(from_vtk(*read_by<vtkOBJReader>(folder / "a.obj"))), 4500.0, 1e-2);
}

}  // namespace brainshift::test::write_surface_test
