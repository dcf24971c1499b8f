// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>

#include "discretise/discretise.hpp"
#include "tests/unit/discretise/bodies.hpp"

namespace brainshift::discretise {
namespace {

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

Eigen::Matrix<double, 4, 3> tetrahedron(const BackgroundCells& cells, std::size_t cell) {
  Eigen::Matrix<double, 4, 3> x;
  for (std::size_t k = 0; k < 4; ++k) {
    x.row(static_cast<Eigen::Index>(k)) = cells.vertices.row(cells.connectivity[4 * cell + k]);
  }
  return x;
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

TEST(Hexahedra, HoldTheVolumeOfABallWhateverTheirSize) {
  const Surface surface = ball(40, centre, 6);
  const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(40, 3);
  for (const std::size_t nodes : {100U, 800U, 5000U}) {
    const Discretisation result = with_nodes(surface, nodes, CellKind::hexahedron);
    EXPECT_NEAR(result.measures.cells_inside_volume, exact, 1e-3 * exact) << nodes;
    EXPECT_GT(result.measures.cut_cells, 0U);
    EXPECT_LT(result.measures.cut_cells, result.measures.cells);
  }
}

TEST(Hexahedra, OfABoxHoldItsVolumeAlthoughLinesMeetItsEdges) {
  const Discretisation result = with_nodes(box({-4, 0, 8}, {12, 32, 24}), 1000, CellKind::hexahedron);
  EXPECT_NEAR(result.measures.cells_inside_volume, 16.0 * 32 * 16, 0.002 * 16 * 32 * 16);
}

TEST(Hexahedra, AreAsManyANodeAsAsked) {
  DiscretiseOptions options;
  options.nodes = 2000;
  options.cells_per_node = 3;
  const Discretisation result = discretise(bumpy_brain(), nullptr, options);
  const BackgroundCells& cells = result.cells;
  const double edge = cells.vertices(cells.connectivity[1], 0) - cells.vertices(cells.connectivity[0], 0);
  const double per_node = result.measures.surface_volume / std::pow(edge, 3) / static_cast<double>(result.cloud.size());
  EXPECT_NEAR(per_node, 3.0, 0.03);
}

TEST(Hexahedra, HaveOctantsThatAddUpWithCentroidsInsideTheBody) {
  const Surface surface = bumpy_brain();
  const Discretisation result = with_nodes(surface, 1500, CellKind::hexahedron);
  const BackgroundCells& cells = result.cells;
  const Inside inside(surface);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (cells.cut_index[cell] < 0) {
      EXPECT_EQ(cells.inside_fraction[cell], 1.0);
      continue;
    }
    const Eigen::RowVector3d low = cells.vertices.row(cells.connectivity[8 * cell]);
    const Eigen::RowVector3d high = cells.vertices.row(cells.connectivity[8 * cell + 6]);
    const InsideOctants& part = cells.cut_parts[static_cast<std::size_t>(cells.cut_index[cell])];
    double total = 0;
    for (int octant = 0; octant < 8; ++octant) {
      total += part.volume[octant];
      if (part.volume[octant] > 0) {
        EXPECT_TRUE(inside(part.centroid[octant]));
        for (int axis = 0; axis < 3; ++axis) {
          const double place = (part.centroid[octant][axis] - low[axis]) / (high[axis] - low[axis]);
          const int half = octant >> axis & 1;
          EXPECT_GE(place, 0.5 * half - 1e-9);
          EXPECT_LE(place, 0.5 * half + 0.5 + 1e-9);
        }
      }
    }
    EXPECT_NEAR(total, cells.inside_fraction[cell] * (high - low).prod(), 1e-9 * total);
  }
}

TEST(Hexahedra, HaveTheCentroidOfAHalfBallAtThreeEighthsOfItsRadius) {
  // First moment of the ball's upper half from octants and whole cells against the analytic one, pi R^4 / 4.
  const Surface surface = ball(40, centre, 6);
  const BackgroundCells cells = with_nodes(surface, 2000, CellKind::hexahedron).cells;
  double moment = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const Eigen::RowVector3d low = cells.vertices.row(cells.connectivity[8 * cell]);
    const Eigen::RowVector3d edge = cells.vertices.row(cells.connectivity[8 * cell + 6]) - low;
    for (int octant = 0; octant < 8; ++octant) {
      double volume = edge.prod() / 8;
      double z = low[2] + edge[2] * (octant >> 2 != 0 ? 0.75 : 0.25);
      if (cells.cut_index[cell] >= 0) {
        const InsideOctants& part = cells.cut_parts[static_cast<std::size_t>(cells.cut_index[cell])];
        volume = part.volume[octant];
        z = part.centroid[octant][2];
      }
      moment += volume > 0 ? volume * std::max(0.0, z - centre.z()) : 0;
    }
  }
  const double exact = std::numbers::pi * std::pow(40, 4) / 4;
  EXPECT_NEAR(moment, exact, 2e-3 * exact);
}

TEST(Tetrahedra, AreAllPositiveWithTheNodesForVertices) {
  const Discretisation result = with_nodes(bumpy_brain(), 3000, CellKind::tetrahedron);
  EXPECT_EQ(result.cells.vertices, result.cloud.positions);
  ASSERT_GT(result.cells.size(), 10000U);
  for (std::size_t cell = 0; cell < result.cells.size(); ++cell) {
    const Eigen::Matrix<double, 4, 3> x = tetrahedron(result.cells, cell);
    EXPECT_GT((x.bottomRows<3>().rowwise() - x.row(0)).eval().determinant(), 0);
    EXPECT_EQ(result.cells.inside_fraction[cell], 1.0);
  }
  EXPECT_TRUE(result.cells.cut_parts.empty());
}

TEST(Tetrahedra, ApproachTheVolumeOfABallAsTheyGetSmaller) {
  const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(40, 3);
  double previous = 1;
  for (const std::size_t nodes : {250U, 2000U, 16000U}) {
    const Discretisation result = with_nodes(ball(40, centre, 6), nodes, CellKind::tetrahedron);
    const double error = std::abs(result.measures.cells_inside_volume / exact - 1);
    EXPECT_LT(error, 0.4 * previous) << nodes;  // second order: a quarter for each halving of the spacing
    previous = error;
  }
  EXPECT_LT(previous, 5e-3);
}

TEST(Tetrahedra, OfABrainHoldItsVolume) {
  const Discretisation result = with_nodes(bumpy_brain(), 8000, CellKind::tetrahedron);
  EXPECT_NEAR(result.measures.cells_inside_volume / result.measures.surface_volume, 1.0, 5e-3);
}

}  // namespace
}  // namespace brainshift::discretise
