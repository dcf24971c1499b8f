// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/cut_surface.hpp"

#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include "solve/solve.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/cut_bodies.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/pulled_square.hpp"

namespace brainshift::solve::cut_surface_test {

/// A cube that is pulled open across a sheet over half of it.
Model cube() {
  Model model = uniaxial(1.1, 7);
  Cut sheet;
  sheet.name = "sheet";
  sheet.vertices.resize(4, 3);
  sheet.vertices << -5, -5, 30, 30, -5, 30, 30, 65, 30, -5, 65, 30;
  sheet.triangles.resize(2, 3);
  sheet.triangles << 0, 1, 2, 0, 2, 3;
  model.cuts = {sheet};
  return model;
}

/// How far the faces are apart across the cut, along an axis, at their vertices in turn.
Eigen::VectorXd opening(const CutSurface& surface, int axis) {
  const Eigen::Index half = surface.vertices.rows() / 2;
  return (surface.displacement.topRows(half) - surface.displacement.bottomRows(half)).col(axis);
}

TEST(CutSurface, HasTwoFacesThatOpenTowardsTheSurfaceAndMeetAtTheTip) {
  const SolveResult result = solve(pulled_square(), test::plane_options());
  const CutSurface& surface = result.faces;
  const Eigen::Index half = surface.vertices.rows() / 2;
  EXPECT_EQ(surface.vertices.topRows(half), surface.vertices.bottomRows(half));
  EXPECT_NEAR(surface.vertices.col(0).minCoeff(), 0, 1.5);  // half a spacing
  EXPECT_EQ(surface.vertices.col(0).maxCoeff(), 30);
  const Eigen::VectorXd apart = opening(surface, 1);
  for (Eigen::Index i = 0; i + 1 < half; ++i) {
    EXPECT_GT(apart[i], apart[i + 1]);
  }
  EXPECT_GT(apart.maxCoeff(), 4);
  EXPECT_LT(apart.minCoeff(), 0.1);
}

TEST(CutSurface, IsReadByVtk) {
  const test::ScratchFolder folder;
  const SolveResult planar = solve(pulled_square(), test::plane_options()), spatial = solve(cube(), {});
  for (const SolveResult* result : {&planar, &spatial}) {
    const CutSurface& surface = result->faces;
    write_cut_surface(folder / "cut.vtp", surface);
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((folder / "cut.vtp").c_str());
    reader->Update();
    vtkPolyData& read = *reader->GetOutput();
    ASSERT_EQ(read.GetNumberOfPoints(), surface.vertices.rows());
    EXPECT_EQ((result == &planar ? read.GetLines() : read.GetPolys())->GetNumberOfCells(), surface.facets.rows());
    vtkDataArray* displacement = read.GetPointData()->GetArray("displacement");
    vtkDataArray* sides = read.GetPointData()->GetArray("side");
    ASSERT_TRUE(displacement != nullptr && sides != nullptr);
    const vtkIdType last = read.GetNumberOfPoints() - 1;
    EXPECT_EQ(sides->GetTuple1(0), 1);
    EXPECT_EQ(sides->GetTuple1(last), -1);
    EXPECT_EQ(displacement->GetComponent(last, 1), surface.displacement(last, 1));
  }
  EXPECT_GT(opening(spatial.faces, 2).maxCoeff(), 4);
}

}  // namespace brainshift::solve::cut_surface_test
