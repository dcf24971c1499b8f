// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/cut/boundary_normals.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::boundary_normals_test {

struct Answer {
  OrderedCloud cloud;
  std::vector<std::int32_t> nodes;
  std::optional<SurfaceNormals> normals;

  explicit Answer(const Model& model, const CutFacets& cut = {})
      : cloud(order_nodes(model.cloud, model.conditions)), nodes(surface_nodes(cloud)) {
    const ShapeFunctions shape(cloud.positions, cloud.spacing, {});
    normals = boundary_normals(known_boundary(model), cut, cloud, shape.evaluate(cloud.positions, false));
  }

  /// Of the surface node nearest to a place.
  int rank_at(double x, double y, double z) const {
    Eigen::Index nearest = 0;
    const Points at = cloud.positions(nodes, Eigen::all);
    (at.rowwise() - Eigen::RowVector3d(x, y, z)).rowwise().squaredNorm().minCoeff(&nearest);
    return normals->rank[static_cast<std::size_t>(nearest)];
  }
};

constexpr double side = model_side;

TEST(BoundaryNormals, OfPlanesOfSymmetryAreTheirsAlone) {
  const Answer answer(uniaxial(0.8));
  ASSERT_TRUE(answer.normals);
  EXPECT_EQ(answer.rank_at(0, 0, 0), 3);
  EXPECT_EQ(answer.rank_at(side / 6, 0, 0), 2);
  EXPECT_EQ(answer.rank_at(side / 6, side / 6, 0), 1);
}

TEST(BoundaryNormals, BesideABondedFaceAreAllDirections) {
  Model model = uniaxial(0.8);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 2) > side - 1e-9) {
      model.conditions.displacement.row(a).head<2>().setZero();
    }
  }
  const Answer answer(model);
  EXPECT_EQ(answer.rank_at(side / 2, side / 2, side), 3);
  EXPECT_EQ(answer.rank_at(side, side / 2, side - side / 6), 3) << "sees the bonded face";
  EXPECT_EQ(answer.rank_at(side, side / 2, side / 6), 1);
}

TEST(BoundaryNormals, OfTheRimOfACutAreBothSurfaces) {
  CutFacets cut;
  cut.vertices.resize(4, 3);
  cut.vertices << -5, -5, side / 2, side + 5, -5, side / 2, side + 5, side + 5, side / 2, -5, side + 5, side / 2;
  cut.facets.resize(2, 3);
  cut.facets << 0, 1, 2, 0, 2, 3;
  const Model model = uniaxial(0.8);
  EXPECT_EQ(Answer(model).rank_at(side, side / 3, side / 2), 1);
  EXPECT_EQ(Answer(model, cut).rank_at(side, side / 3, side / 2), 2);
}

TEST(BoundaryNormals, AreUnknownWhereTissueIsTakenOut) {
  Model model = uniaxial(0.8);
  model.resection = Resection{{2}, 0};
  EXPECT_EQ(known_boundary(model).triangles.rows(), 0);
  EXPECT_FALSE(Answer(model).normals);
}

}  // namespace brainshift::solve::boundary_normals_test
