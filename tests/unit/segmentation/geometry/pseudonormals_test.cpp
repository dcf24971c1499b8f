// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/pseudonormals.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::pseudonormals_test {

using test::box;
using test::refusal;

const Eigen::Vector3d low(1, 2, 3), high(3, 5, 9);
const Eigen::Vector3d centre = 0.5 * (low + high);

TEST(Pseudonormals, OfABoxsFacesAreItsUnitNormals) {
  const Surface body = box(low, high);
  const Pseudonormals normals = pseudonormals(body);
  ASSERT_EQ(normals.face.size(), 12U);
  for (std::size_t t = 0; t < normals.face.size(); ++t) {
    const Eigen::Vector3d from_centre = triangle(body, static_cast<Eigen::Index>(t)).centroid() - centre;
    EXPECT_NEAR(normals.face[t].norm(), 1, 1e-15);
    EXPECT_NEAR(normals.face[t].lpNorm<1>(), 1, 1e-15) << "along an axis";
    EXPECT_GT(normals.face[t].dot(from_centre), 0);
    EXPECT_EQ(normals.of(t, TrianglePart::face), normals.face[t]);
  }
}

TEST(Pseudonormals, OfABoxsCornersAreTheSameWhicheverWayItsSidesAreSplit) {
  const Surface body = box(low, high);
  const Pseudonormals normals = pseudonormals(body);
  for (std::size_t v = 0; v < normals.vertex.size(); ++v) {
    const Eigen::Vector3d sign = (body.vertices.row(static_cast<Eigen::Index>(v)).transpose() - centre).cwiseSign();
    EXPECT_TRUE(normals.vertex[v].isApprox(0.5 * std::numbers::pi * sign, 1e-12)) << v;
  }
}

TEST(Pseudonormals, OfAnEdgeAreTheSumOfItsTwoFaces) {
  const Surface body = box(low, high);
  const Pseudonormals normals = pseudonormals(body);
  constexpr TrianglePart parts[] = {TrianglePart::edge_ab, TrianglePart::edge_bc, TrianglePart::edge_ca};
  for (std::size_t t = 0; t < normals.face.size(); ++t) {
    for (int side = 0; side < 3; ++side) {
      const auto corner = body.triangles.row(static_cast<Eigen::Index>(t));
      const Eigen::Vector3d along = body.vertices.row(corner[(side + 1) % 3]) - body.vertices.row(corner[side]);
      const bool across_a_side = (along.array() != 0).count() == 2;
      const Eigen::Vector3d& normal = normals.of(t, parts[side]);
      EXPECT_NEAR(normal.norm(), across_a_side ? 2 : std::sqrt(2.0), 1e-12);
      EXPECT_NEAR(normal.dot(normals.face[t]), across_a_side ? 2 : 1, 1e-12);
    }
  }
}

TEST(Pseudonormals, OfAVertexAreFoundByThePartOfTheTriangle) {
  const Surface body = box(low, high);
  const Pseudonormals normals = pseudonormals(body);
  constexpr TrianglePart parts[] = {TrianglePart::vertex_a, TrianglePart::vertex_b, TrianglePart::vertex_c};
  for (int corner = 0; corner < 3; ++corner) {
    const auto vertex = static_cast<std::size_t>(body.triangles(5, corner));
    EXPECT_EQ(normals.of(5, parts[corner]), normals.vertex[vertex]);
  }
}

TEST(Pseudonormals, OfASurfaceThatHasNoInsideAreRefused) {
  const Surface body = box(low, high);
  const auto fault = [](const Surface& surface) { return refusal([&] { pseudonormals(surface); }); };
  EXPECT_EQ(fault(body), "");
  EXPECT_NE(fault({}).find("no triangle"), std::string::npos);
  Surface wrong = body;
  wrong.triangles(3, 1) = 8;
  EXPECT_NE(fault(wrong).find("does not exist"), std::string::npos);
  wrong = body;
  wrong.vertices(2, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(fault(wrong).find("not finite"), std::string::npos);
  wrong = body;
  wrong.triangles = body.triangles.topRows(11).eval();
  EXPECT_NE(fault(wrong).find("is open"), std::string::npos);
  wrong = body;
  wrong.triangles.row(0).reverseInPlace();
  EXPECT_NE(fault(wrong).find("evenly oriented"), std::string::npos);
  wrong = body;
  wrong.triangles.col(0).swap(wrong.triangles.col(1));
  EXPECT_NE(fault(wrong).find("inside out"), std::string::npos);
}

}  // namespace brainshift::pseudonormals_test
