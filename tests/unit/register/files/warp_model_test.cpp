// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/warp_model.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include "segmentation/files/model_file.hpp"
#include "tests/unit/register/shifted.hpp"

namespace brainshift::registration::warp_model_test {

using namespace builders;

class WarpModel : public Shifted {
 protected:
  vtkSmartPointer<vtkPointSet> warped(const std::string& name, const std::string& text) {
    warp_model(folder_.write(name, text), mover_, folder_ / ("warped_" + name));
    return read_model(folder_ / ("warped_" + name));
  }
  std::string refused(const std::string& name, const std::string& text) {
    return test::refusal([&] { warp_model(folder_.write(name, text), mover_, folder_ / ("warped_" + name)); });
  }
};

/// A tract of three points and a single point, with arrays on points, lines and the whole.
std::string tract_vtp(const std::string& frame) {
  return R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData><FieldData>
    <Array type="String" Name="SPACE" NumberOfTuples="1" format="ascii">)" +
         std::string(frame == "RAS" ? "82 65 83 0" : "76 80 83 0") + R"(</Array></FieldData>
    <Piece NumberOfPoints="4" NumberOfVerts="1" NumberOfLines="1" NumberOfStrips="0" NumberOfPolys="0">
    <PointData Scalars="fa"><DataArray type="Float32" Name="fa" format="ascii">0.1 0.2 0.3 0.4</DataArray>
    <DataArray type="Int32" Name="id" NumberOfComponents="2" format="ascii">1 2 3 4 5 6 7 8</DataArray></PointData>
    <CellData><DataArray type="UInt8" Name="bundle" format="ascii">7 9</DataArray></CellData>
    <Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
      3 -5 8  3 -5 9  4 -5 9  0 0 1000</DataArray></Points>
    <Verts><DataArray type="Int64" Name="connectivity" format="ascii">3</DataArray>
      <DataArray type="Int64" Name="offsets" format="ascii">1</DataArray></Verts>
    <Lines><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
      <DataArray type="Int64" Name="offsets" format="ascii">3</DataArray></Lines>
    </Piece></PolyData></VTKFile>)";
}

std::string legacy(const std::string& version, const std::string& cells) {
  return "# vtk DataFile Version " + version + "\ntract of a patient\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n" +
         "3 -5 8 3 -5 9 4 -5 9\n" + cells + "\nPOINT_DATA 3\nSCALARS fa float 1\nLOOKUP_TABLE default\n0.1 0.2 0.3\n" +
         "SCALARS md float 1\nLOOKUP_TABLE default\n5 6 7\n";
}

TEST_F(WarpModel, TheErrorIsThatOfThePlacesBeforeTheyMove) {
  PointMover mover(field_, heights);
  warp_model(folder_.write("tract.vtp", tract_vtp("RAS")), mover, folder_ / "moved.vtp");
  const auto moved = read_model(folder_ / "moved.vtp");
  vtkDataArray* const error = moved->GetPointData()->GetArray("estimated_error");
  ASSERT_NE(error, nullptr);
  EXPECT_EQ(error->GetTuple1(0), 8);
  EXPECT_EQ(error->GetTuple1(3), 1000);
  EXPECT_EQ(moved->GetPointData()->GetArray("uncertainty")->GetTuple1(3), 2000);
}

TEST_F(WarpModel, LinesAndPointsMoveAndKeepAllArrays) {
  const auto model = warped("tracts.vtp", tract_vtp("LPS"));
  EXPECT_LT((Eigen::Vector3d(model->GetPoint(1)) - Eigen::Vector3d(4.5, -7, 12)).norm(), 1e-12);
  EXPECT_EQ(Eigen::Vector3d(model->GetPoint(3)), Eigen::Vector3d(0, 0, 1000)) << "outside the image";
  EXPECT_EQ(model->GetNumberOfCells(), 2);
  EXPECT_EQ(model->GetPointData()->GetArray("fa")->GetTuple1(2), 0.3F);
  EXPECT_EQ(model->GetPointData()->GetArray("id")->GetComponent(3, 1), 8);
  EXPECT_EQ(model->GetCellData()->GetArray("bundle")->GetTuple1(1), 9);
  EXPECT_EQ(Eigen::Vector3d(model->GetPointData()->GetArray("displacement")->GetTuple3(0)), shift);
  EXPECT_EQ(mover_.moved().points, 4U);
  EXPECT_EQ(mover_.moved().outside, 1U);
  EXPECT_NEAR(mover_.moved().largest, shift.norm(), 1e-6);
}

TEST_F(WarpModel, AModelInRasMovesInRas) {
  std::string text = tract_vtp("RAS");
  text.replace(text.find("3 -5 8  3"), 6, "-3 5 8");
  const auto model = warped("tracts.vtp", text);
  EXPECT_LT((Eigen::Vector3d(model->GetPoint(0)) - Eigen::Vector3d(-4.5, 7, 11)).norm(), 1e-12);
  EXPECT_EQ(Eigen::Vector3d(model->GetPointData()->GetArray("displacement")->GetTuple3(0)),
            Eigen::Vector3d(-1.5, 2, 3));
  EXPECT_EQ(frame_of_model(folder_ / "warped_tracts.vtp", *model), Frame::ras);
}

TEST_F(WarpModel, AnArrayOfTheSameNameStays) {
  std::string text = tract_vtp("LPS");
  text.replace(text.find("\"id\""), 4, "\"displacement\"");
  const auto model = warped("tracts.vtp", text);
  vtkPointData& arrays = *model->GetPointData();
  EXPECT_EQ(arrays.GetArray("displacement")->GetComponent(3, 1), 8);
  EXPECT_EQ(Eigen::Vector3d(arrays.GetArray("warp_displacement")->GetTuple3(0)), shift);
  warp_model(folder_ / "warped_tracts.vtp", mover_, folder_ / "again.vtp");
  const auto again = read_model(folder_ / "again.vtp");
  EXPECT_NE(again->GetPointData()->GetArray("warp_warp_displacement"), nullptr);
}

TEST_F(WarpModel, LegacyFilesKeepTheirFormVersionAndTitle) {
  for (const auto& [version, cells] :
       {std::pair("3.0", "LINES 1 4\n3 0 1 2"),
        std::pair("5.1", "LINES 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 1 2")}) {
    const auto model = warped("tracts.vtk", legacy(version, cells));
    EXPECT_LT((Eigen::Vector3d(model->GetPoint(1)) - Eigen::Vector3d(4.5, -7, 12)).norm(), 1e-6);
    EXPECT_EQ(model->GetPointData()->GetArray("fa")->GetTuple1(2), 0.3F);
    EXPECT_EQ(model->GetPointData()->GetArray("md")->GetTuple1(0), 5);
    const std::string text = test::bytes_of(folder_ / "warped_tracts.vtk");
    EXPECT_TRUE(text.starts_with(std::string("# vtk DataFile Version ") + (version[0] == '3' ? "4.2" : "5.1") +
                                 "\ntract of a patient\nASCII\n"))
        << text.substr(0, 60);
  }
}

TEST_F(WarpModel, PlacesOfWholeNumbersBecomeReal) {
  std::string text = tract_vtp("LPS");
  text.replace(text.find("Float64"), 7, "Int32");
  const auto model = warped("tracts.vtp", text);
  EXPECT_LT((Eigen::Vector3d(model->GetPoint(1)) - Eigen::Vector3d(4.5, -7, 12)).norm(), 1e-12);
  std::string old = legacy("3.0", "LINES 1 4\n3 0 1 2");
  old.replace(old.find("POINTS 3 float"), 14, "POINTS 3 short");
  EXPECT_LT((Eigen::Vector3d(warped("old.vtk", old)->GetPoint(1)) - Eigen::Vector3d(4.5, -7, 12)).norm(), 1e-6);
}

TEST_F(WarpModel, WhatCannotBeReadIsRefusedByName) {
  const std::string whole = tract_vtp("LPS");
  EXPECT_NE(refused("cut.vtp", whole.substr(0, whole.size() / 2)).find("cut.vtp: is no .vtp"), std::string::npos);
  EXPECT_NE(refused("cut.vtk", legacy("3.0", "LINES 1 4\n3 0 1 2").substr(0, 90)).find("cut.vtk"), std::string::npos);
  for (const char* cells :
       {"LINES 1 400\n3 0 1 2", "LINES 5 4\n3 0 1 2", "LINES 1 4\n9 0 1 2", "LINES 1 4\n3 0 1 99"}) {
    EXPECT_NE(refused("cells.vtk", legacy("3.0", cells)).find("cells.vtk: "), std::string::npos) << cells;
  }
  EXPECT_NE(refused("text.vtk", "nothing\n").find("text.vtk: is no legacy .vtk"), std::string::npos);
  std::string not_finite = legacy("3.0", "LINES 1 4\n3 0 1 2");
  not_finite.replace(not_finite.find("-5 9 4"), 2, "nan");
  EXPECT_NE(refused("nan.vtk", not_finite).find("nan.vtk"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "warped_nan.vtk"));
}

}  // namespace brainshift::registration::warp_model_test
