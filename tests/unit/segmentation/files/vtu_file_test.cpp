// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/vtu_file.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <limits>

#include "segmentation/files/vtk_bridge.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::vtu_file_test {

Points some_points() {
  Points points(3, 3);
  points << 0.1, -2, 1e-17, 1.0 / 3.0, 5, 6, 7, 8, 1e6;
  return points;
}

/// A grid of one tetrahedron as another program may write it.
std::string tetrahedron_file(const std::string& connectivity, const std::string& offset) {
  return R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="1"><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells><DataArray type="Int64" Name="connectivity" format="ascii">)" +
         connectivity + R"(</DataArray><DataArray type="Int64" Name="offsets" format="ascii">)" + offset +
         R"(</DataArray><DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells></Piece>
</UnstructuredGrid></VTKFile>)";
}

TEST(VtuFile, GivesBackEveryBitOfPointsAndArrays) {
  const ScratchFolder folder;
  const auto grid = vtu::vertex_grid(some_points());
  const std::vector<double> vectors = {1, 2, 3, 0.1, 0.2, 0.3, -1, 1e-300, 0};
  const std::vector<std::int32_t> labels = {-5, 0, std::numeric_limits<std::int32_t>::max()};
  const std::vector<std::uint8_t> flags = {0, 1, 255};
  vtu::add_array(*grid->GetPointData(), "vectors", vectors, 3);
  vtu::add_array(*grid->GetCellData(), "labels", labels);
  vtu::add_array(*grid->GetCellData(), "flags", flags);
  const auto file = folder / "a.vtu";
  vtu::write(file, *grid);
  const auto back = vtu::read(file);
  EXPECT_EQ(back->GetNumberOfCells(), 3);
  EXPECT_EQ(vtu::points(file, *back, "node"), some_points());
  EXPECT_EQ(vtu::array(file, *back->GetPointData(), "vectors", 3, 3), vectors);
  EXPECT_EQ(vtu::whole_number_array(file, *back->GetCellData(), "labels", 3, "node"), labels);
  EXPECT_EQ(vtu::array(file, *back->GetCellData(), "flags", 3), (std::vector<double>{0, 1, 255}));
  vtu::write(folder / "b.vtu", *back);
  EXPECT_EQ(bytes_of(folder / "b.vtu"), bytes_of(file));
}

TEST(VtuFile, OfPolyDataIsReadByVtk) {
  const ScratchFolder folder;
  const auto data = to_vtk(tetrahedron());
  vtu::write(folder / "a.vtp", *data);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "a.vtp").c_str());
  reader->Update();
  EXPECT_EQ(from_vtk(*reader->GetOutput()).vertices, tetrahedron().vertices);
}

TEST(VtuFile, AnArrayOfAnotherShapeOrWithoutNumbersIsRefused) {
  const auto grid = vtu::vertex_grid(some_points());
  vtkPointData& data = *grid->GetPointData();
  vtu::add_array(data, "pairs", std::vector<double>{1, 2, 3, 4, 5, 6}, 2);
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  names->SetNumberOfTuples(3);
  data.AddArray(names);
  const auto fault = [&](const char* name, std::size_t rows, int components) {
    return refusal([&] { vtu::array("a.vtu", data, name, rows, components); });
  };
  EXPECT_TRUE(vtu::array("a.vtu", data, "nothing", 3).empty());
  EXPECT_EQ(fault("pairs", 3, 2), "");
  EXPECT_NE(fault("pairs", 3, 1).find("3 rows of 2 components; 3 rows of 1"), std::string::npos);
  EXPECT_NE(fault("pairs", 6, 2).find("6 rows of 2 are expected"), std::string::npos);
  EXPECT_NE(fault("names", 3, 1).find("no numbers"), std::string::npos);
}

TEST(VtuFile, ALabelThatIsNoWholeNumberIsRefusedWithItsRow) {
  const auto grid = vtu::vertex_grid(some_points());
  for (const double wrong : {0.5, 3e9, std::numeric_limits<double>::quiet_NaN()}) {
    vtu::add_array(*grid->GetPointData(), "label", std::vector<double>{1, 2, wrong});
    const std::string sentence =
        refusal([&] { vtu::whole_number_array("a.vtu", *grid->GetPointData(), "label", 3, "cell"); });
    EXPECT_NE(sentence.find("label of cell 2"), std::string::npos) << sentence;
  }
}

TEST(VtuFile, APointThatIsNotFiniteIsNamed) {
  Points points = some_points();
  points(1, 2) = std::numeric_limits<double>::infinity();
  const auto grid = vtu::vertex_grid(points);
  EXPECT_NE(refusal([&] { vtu::points("a.vtu", *grid, "node"); }).find("a.vtu: node 1"), std::string::npos);
}

TEST(VtuFile, CellsThatReachOutOfTheArraysAreRefused) {
  const ScratchFolder folder;
  const auto fault = [&](const std::string& connectivity, const std::string& offset) {
    const auto file = folder.write("a.vtu", tetrahedron_file(connectivity, offset));
    return refusal([&] { vtu::read(file); });
  };
  EXPECT_EQ(fault("0 1 2 3", "4"), "");
  EXPECT_NE(fault("0 1 2 4", "4").find("a point that does not exist"), std::string::npos);
  EXPECT_NE(fault("0 1 -2 3", "4").find("a point that does not exist"), std::string::npos);
  EXPECT_NE(fault("0 1 2 3", "9").find("a.vtu"), std::string::npos);
}

TEST(VtuFile, ThatIsMissingEmptyTruncatedOrSomethingElseIsRefusedByName) {
  const ScratchFolder folder;
  const auto refused = [&](const std::string& name) {
    const std::string sentence = refusal([&] { vtu::read(folder / name); });
    return sentence.find(name) != std::string::npos;
  };
  EXPECT_TRUE(refused("missing.vtu"));
  folder.write("empty.vtu", "");
  EXPECT_TRUE(refused("empty.vtu"));
  folder.write("text.vtu", "x,y,z\n1,2,3\n");
  EXPECT_TRUE(refused("text.vtu"));
  folder.write("poly.vtu", R"(<VTKFile type="PolyData" version="1.0"><PolyData/></VTKFile>)");
  EXPECT_TRUE(refused("poly.vtu"));
  vtu::write(folder / "whole.vtu", *vtu::vertex_grid(Points::Random(500, 3)));
  const std::string whole = bytes_of(folder / "whole.vtu");
  for (const double part : {0.2, 0.5, 0.8, 0.95}) {
    folder.write("part.vtu", whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
    EXPECT_TRUE(refused("part.vtu")) << part;
  }
}

TEST(VtuFile, ThatCannotBeWrittenIsAFaultOfOutput) {
  const auto grid = vtu::vertex_grid(some_points());
  EXPECT_THROW(vtu::write("/nonexistent/folder/nodes.vtu", *grid), std::runtime_error);
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_THROW(vtu::write("/dev/full", *grid), std::runtime_error);
  }
}

}  // namespace brainshift::test::vtu_file_test
