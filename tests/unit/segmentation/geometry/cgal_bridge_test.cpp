// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/cgal_bridge.hpp"

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/iterator.h>
#include <gtest/gtest.h>

#include <cmath>

#include "segmentation/surface/surface_measures.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::cgal_bridge_test {

const Surface body = test::box({-1, 2, 3}, {4, 6, 9});

/// Each triangle with corners of its own, as STL files hold them.
Surface torn_apart(const Surface& surface) {
  Surface apart{Points(3 * surface.triangles.rows(), 3), Triangles(surface.triangles.rows(), 3)};
  for (Eigen::Index triangle = 0; triangle < surface.triangles.rows(); ++triangle) {
    for (Eigen::Index corner = 0; corner < 3; ++corner) {
      const Eigen::Index vertex = 3 * triangle + corner;
      apart.vertices.row(vertex) = surface.vertices.row(surface.triangles(triangle, corner));
      apart.triangles(triangle, corner) = static_cast<std::int32_t>(vertex);
    }
  }
  return apart;
}

TEST(CgalBridge, GivesBackASurfaceNumberedAsItWas) {
  const Surface back = from_mesh(to_mesh(body).value());
  EXPECT_EQ(back.vertices, body.vertices);
  ASSERT_EQ(back.triangles.rows(), body.triangles.rows());
  for (Eigen::Index triangle = 0; triangle < body.triangles.rows(); ++triangle) {
    Eigen::RowVector3i turned = back.triangles.row(triangle);
    for (int turn = 0; turn < 2 && turned != body.triangles.row(triangle); ++turn) {
      turned = Eigen::RowVector3i(turned[1], turned[2], turned[0]);
    }
    EXPECT_EQ(turned, body.triangles.row(triangle)) << "the same corners in the same sense";
  }
}

TEST(CgalBridge, HasNoMeshOfASurfaceThatIsNotAManifoldOrOrientedAlike) {
  Surface flipped = body;
  flipped.triangles.row(3).reverseInPlace();
  EXPECT_FALSE(to_mesh(flipped));
  Surface fin = body;  // a third triangle at an edge
  fin.vertices.conservativeResize(9, 3);
  fin.vertices.row(8) << 20, 20, 20;
  fin.triangles.conservativeResize(13, 3);
  fin.triangles.row(12) << body.triangles(0, 0), body.triangles(0, 1), 8;
  EXPECT_FALSE(to_mesh(fin));
  Surface open = body;
  open.triangles.conservativeResize(11, 3);
  EXPECT_TRUE(to_mesh(open)) << "it may be open";
}

TEST(CgalBridge, RepairMergesRepeatedPointsAndTurnsTrianglesToAgree) {
  Surface broken = torn_apart(body);
  broken.triangles.row(5).reverseInPlace();
  const Surface repaired = from_mesh(to_repaired_mesh(broken));
  EXPECT_EQ(repaired.vertices.rows(), 8);
  EXPECT_TRUE(segmentation::measure(repaired).closed);
  EXPECT_NEAR(std::abs(volume(repaired)), 5 * 4 * 6, 1e-9);
}

TEST(CgalBridge, RepairDoublesVerticesWhereASurfaceIsNoManifold) {
  Surface fin = body;
  fin.vertices.conservativeResize(9, 3);
  fin.vertices.row(8) << 20, 20, 20;
  fin.triangles.conservativeResize(13, 3);
  fin.triangles.row(12) << body.triangles(0, 0), body.triangles(0, 1), 8;
  const CgalMesh mesh = to_repaired_mesh(fin);
  EXPECT_EQ(mesh.number_of_faces(), 13U);
  EXPECT_GT(mesh.number_of_vertices(), 9U) << "those at the edge are doubled";
  EXPECT_TRUE(mesh.is_valid());
}

TEST(CgalBridge, LeavesOutWhatWasRemovedFromAMesh) {
  CgalMesh mesh = to_mesh(body).value();
  const std::vector<CgalMesh::Face_index> around(
      CGAL::faces_around_target(mesh.halfedge(CgalMesh::Vertex_index(0)), mesh).begin(),
      CGAL::faces_around_target(mesh.halfedge(CgalMesh::Vertex_index(0)), mesh).end());
  for (const CgalMesh::Face_index face : around) {
    CGAL::Euler::remove_face(mesh.halfedge(face), mesh);
  }
  const Surface rest = from_mesh(mesh);
  EXPECT_EQ(rest.vertices.rows(), 7);
  EXPECT_EQ(rest.triangles.rows(), 12 - static_cast<Eigen::Index>(around.size()));
  EXPECT_EQ(rest.triangles.maxCoeff(), 6);
  for (const auto& vertex : rest.vertices.rowwise()) {
    EXPECT_NE(vertex, body.vertices.row(0));
  }
}

}  // namespace brainshift::cgal_bridge_test
