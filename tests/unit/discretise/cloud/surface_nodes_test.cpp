// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <array>

#include "discretise/discretise.hpp"
#include "tests/unit/discretise/bodies.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::discretise::surface_nodes_test {

using test::ball;
using test::box;
using test::bumpy_brain;
const Eigen::Vector3d centre(30, -210, 55);

/// CGAL's exact inside test.
class Inside {
 public:
  explicit Inside(const Surface& surface) : mesh_(to_mesh(surface)), side_(mesh_) {}
  bool operator()(const double* x) const { return side_({x[0], x[1], x[2]}) == CGAL::ON_BOUNDED_SIDE; }

 private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

  static Mesh to_mesh(const Surface& surface) {
    std::vector<Kernel::Point_3> points;
    for (const auto& v : surface.vertices.rowwise()) {
      points.emplace_back(v[0], v[1], v[2]);
    }
    std::vector<std::array<std::size_t, 3>> triangles;
    for (const auto& t : surface.triangles.rowwise()) {
      triangles.push_back(
          {static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2])});
    }
    Mesh mesh;
    CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, mesh);
    return mesh;
  }

  Mesh mesh_;
  CGAL::Side_of_triangle_mesh<Mesh, Kernel> side_;
};

Discretisation with_nodes(const Surface& surface, std::size_t nodes, CellKind kind) {
  DiscretiseOptions options;
  options.nodes = nodes;
  options.cells = kind;
  return discretise(surface, nullptr, options);
}

TEST(Cloud, HasNoNodeOutsideTheSurface) {
  for (const Surface& surface : {bumpy_brain(), box({-3, 40, 7}, {20, 90, 31})}) {
    const Discretisation result = with_nodes(surface, 3000, CellKind::hexahedron);
    const Inside inside(surface);
    for (Eigen::Index node = 0; node < result.cloud.positions.rows(); ++node) {
      EXPECT_TRUE(inside(result.cloud.positions.row(node).data())) << node;
    }
  }
}

TEST(Cloud, HasItsSurfaceNodesOnTheSphere) {
  const Discretisation result = with_nodes(ball(40, centre, 6), 2000, CellKind::hexahedron);
  std::size_t on_surface = 0;
  for (std::size_t node = 0; node < result.cloud.size(); ++node) {
    const double depth = 40 - (result.cloud.positions.row(static_cast<Eigen::Index>(node)) - centre.transpose()).norm();
    if (result.cloud.on_surface[node] == 1) {
      EXPECT_LT(depth, 0.02);  // sagitta of the sphere's triangles
      ++on_surface;
    } else {
      EXPECT_GT(depth, 0.25 * result.cloud.spacing[node]);
    }
  }
  EXPECT_EQ(on_surface, result.measures.surface_nodes);
  EXPECT_GT(on_surface, 300U);
}

}  // namespace brainshift::discretise::surface_nodes_test
