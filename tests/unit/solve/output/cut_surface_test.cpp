// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/cut_surface.hpp"

#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include "solve/cut/inside_body.hpp"
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

/// A body at rest that a strip parts, of small facets in three columns; the last goes back below.
TEST(CutSurface, SharesItsVerticesExceptWhereItIsBentSharply) {
  const Model model = uniaxial(1, 7);
  constexpr int rows = 9;
  Points vertices(4 * rows, 3);
  std::vector<std::array<std::int32_t, 3>> facets;
  for (int i = 0; i < rows; ++i) {
    const double y = 20 + 2.5 * i;
    vertices.middleRows(4 * i, 4) << 20, y, 30, 22.5, y, 30.5, 25, y, 30, 23, y, 29.5;
    for (int j = 0; j < 3 && i + 1 < rows; ++j) {
      const std::int32_t a = 4 * i + j, b = a + 4;
      facets.insert(facets.end(), {{a, a + 1, b + 1}, {a, b + 1, b}});
    }
  }
  Solution solution{.positions = model.cloud.positions,
                    .displacement = model.cloud.positions,
                    .reaction_force = {},
                    .spacing = model.cloud.spacing,
                    .shape = {}};
  solution.cut = {.planar = false, .vertices = vertices, .facets = Triangles(facets.size(), 3), .front = {}};
  for (std::size_t f = 0; f < facets.size(); ++f) {
    solution.cut.facets.row(static_cast<Eigen::Index>(f)) << facets[f][0], facets[f][1], facets[f][2];
  }
  const std::vector<double> volume(model.cloud.size(), 1000);
  const CutSurface surface = cut_surface(solution, {model.cloud.positions, volume, false});
  const Eigen::Index half = surface.vertices.rows() / 2, bend = rows;
  EXPECT_EQ(surface.facets.rows() / 2, solution.cut.facets.rows());
  EXPECT_GE(half, 4 * rows + bend);
  EXPECT_LE(half, 4 * rows + 5 * bend) << "those at the bend for each facet";
  EXPECT_LT((surface.displacement - surface.vertices).rowwise().norm().maxCoeff(), 0.02) << "a linear field";
}

}  // namespace brainshift::solve::cut_surface_test
